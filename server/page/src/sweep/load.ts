// A sweep with all rows of its table.
import type { Sweep, SweepTable_Row } from "../../gen/cellcrush/v1/sweep_pb";
import { api } from "../api/clients";
import { idOf } from "../api/names";

export interface LoadedSweep { sweep: Sweep; rows: SweepTable_Row[]; fields: string[] }

export async function loadSweep(name: string, signal?: AbortSignal): Promise<LoadedSweep> {
  const sweep = await api.sweeps.getSweep({ name }, { signal });
  const rows: SweepTable_Row[] = [];
  let fields: string[] = [];
  let pageToken = "";
  do {
    const page = await api.sweeps.getSweepTable({ name, pageToken }, { signal });
    if (page.fields.length) fields = page.fields;
    rows.push(...page.rows);
    pageToken = page.nextPageToken;
  } while (pageToken);
  return { sweep, rows, fields };
}

export const titleOfSweep = (sweep: Sweep): string => sweep.case?.title || `Sweep ${idOf(sweep.name)}`;

/** Paths of the varied fields. */
export function pathsOf(sweep: Sweep): string[] {
  return sweep.axes.length ? sweep.axes.map((axis) => axis.field) : Object.keys(sweep.points[0]?.fields ?? {});
}
