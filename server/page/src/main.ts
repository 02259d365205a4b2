// Start of the page: the bar at the top, the watch, and the views by path.
import "uplot/dist/uPlot.min.css";
import "./style/theme.css";
import "./style/layout.css";
import "./style/jobs.css";
import "./style/job.css";
import "./style/note.css";
import "./style/sweep.css";
import "./style/new_case.css";
import "./style/server.css";
import { learnCaller } from "./api/caller";
import { api } from "./api/clients";
import { otherServer } from "./api/epoch";
import { exportedBy, isExported } from "./api/exported";
import { chooseTheme, kThemes, startTheme, theme, type Theme } from "./dom/preferences";
import { forgetToken, hasToken } from "./api/token";
import { watch, type Connection } from "./api/watch";
import { ComparePage } from "./compare/page";
import { button, h, setText } from "./dom/element";
import { JobPage } from "./job/page";
import { JobsPage } from "./jobs/page";
import { NewCasePage } from "./new_case/page";
import { route, showOnly, startRouter, valuesOfUrl } from "./router";
import { HelpPage } from "./server/help";
import { ServerPage } from "./server/page";
import { SweepPage } from "./sweep/page";
import { urlOf } from "./dom/base";

const kConnectionWords: Record<Connection, string> = {
  connecting: "connecting",
  live: "live",
  away: "The daemon does not answer. The page catches up when it is back.",
  hidden: "paused",
  other: "another server",
};

function topBar(): HTMLElement {
  const status = h("span", { class: "connection", role: "status" });
  const retry = button("Try now", () => watch.retryNow(), { hidden: true });
  const version = h("span", { class: "faint version" });
  const show = (state: Connection): void => {
    status.dataset.state = state;
    setText(status, kConnectionWords[state]);
    retry.hidden = state !== "away";
  };
  watch.connection.add(show);
  show(watch.state);
  const tellVersion = async (): Promise<void> => {
    const { version: text, draining } = await api.admin.getCapabilities({});
    setText(version, draining ? "the daemon drains" : `cellcrush ${text.split("+")[0]}`);
    version.title = text;
  };
  watch.freshStarts.add(() => void tellVersion().catch(() => undefined));
  return h("header", { class: "top" },
    h("a", { class: "brand", href: urlOf("/") }, iconOfPage(), "cellcrush"),
    h("nav", {}, h("a", { href: urlOf("/") }, "Jobs"), h("a", { href: urlOf("/new") }, "New case"),
      h("a", { href: urlOf("/server") }, "Server"), h("a", { href: urlOf("/help") }, "Help")),
    h("span", { class: "spacer" }), version, themeChoice(),
    hasToken() ? button("Forget the token", forgetToken, { class: "quiet" }) : null, status, retry);
}

// Nothing of the former server stays, not even a question that is open.
function dropFormerServer(): void {
  for (const dialog of document.querySelectorAll("dialog")) dialog.remove();
  showOnly({
    title: "Another server", destroy: () => undefined,
    element: h("div", { class: "page other-server", role: "alert" }, h("h1", {}, "Another server answers here now"),
      h("p", {}, `The server at ${location.host} has other data than the one that this tab showed: another data folder,`
        + " or a restored backup. Its jobs are others, even under the same numbers. Nothing of it was changed."),
      button("Show the jobs of this server", () => location.assign("/"), { class: "primary" })),
  });
}

function themeChoice(): HTMLElement {
  const choice = h("select", { class: "theme", "aria-label": "Theme", title: "Theme",
                               change: () => chooseTheme(choice.value as Theme) },
    ...kThemes.map((name) => h("option", { value: name }, name)));
  choice.value = theme();
  return choice;
}

function iconOfPage(): HTMLElement {
  const link = document.querySelector<HTMLLinkElement>("link[rel=icon]")!;
  link.href = String(link.href); // relative to the address at the start, which the router changes
  return h("img", { src: link.href, alt: "", width: 22, height: 22 });
}

// The job of a file that was exported.
async function showExported(main: HTMLElement): Promise<void> {
  const top = h("header", { class: "top" }, h("span", { class: "brand" }, iconOfPage(), "cellcrush"),
    h("span", { class: "spacer" }), h("span", { class: "faint version" }, `exported by ${exportedBy()}`));
  document.body.append(top, main);
  const { name } = await api.jobs.getJob({});
  main.append(new JobPage(name, valuesOfUrl()).element);
}

route(/^\/$/, (_, query) => new JobsPage(query));
route(/^\/jobs\/(\d+)$/, (match, query) => new JobPage(`jobs/${match[1]}`, query));
route(/^\/sweeps\/(\d+)$/, (match, query) => new SweepPage(`sweeps/${match[1]}`, query));
route(/^\/compare$/, (_, query) => new ComparePage(query));
route(/^\/new$/, (_, query) => new NewCasePage(query));
route(/^\/server$/, () => new ServerPage());
route(/^\/help$/, () => new HelpPage());
route(/^/, () => ({
  title: "Not found", destroy: () => undefined,
  element: h("div", { class: "page" }, h("h1", {}, "There is no such page"),
    h("p", { class: "empty" }, h("a", { href: urlOf("/") }, "All jobs"))),
}));

startTheme();
const main = h("main", { id: "main" });
if (isExported) {
  void showExported(main);
} else {
  document.body.append(h("a", { class: "skip", href: "#main" }, "To the content"), topBar(), main);
  otherServer.add(dropFormerServer);
  watch.start();
  // Views show what the caller may do.
  void learnCaller().then(() => startRouter(main));
}
