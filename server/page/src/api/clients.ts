// Clients of the daemon's services, on the origin of the page; in an exported page, of the file itself.
import { createClient } from "@connectrpc/connect";
import { createConnectTransport } from "@connectrpc/connect-web";
import { Admin } from "../../gen/cellcrush/v1/admin_service_pb";
import { Cases } from "../../gen/cellcrush/v1/cases_service_pb";
import { Jobs } from "../../gen/cellcrush/v1/jobs_service_pb";
import { Sweeps } from "../../gen/cellcrush/v1/sweeps_service_pb";
import { exportedTransport, isExported } from "./exported";
import { withToken } from "./token";

const transport = isExported ? exportedTransport
  : createConnectTransport({ baseUrl: location.origin, useBinaryFormat: true, interceptors: [withToken] });

export const api = {
  admin: createClient(Admin, transport),
  cases: createClient(Cases, transport),
  jobs: createClient(Jobs, transport),
  sweeps: createClient(Sweeps, transport),
};
