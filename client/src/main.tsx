import { render } from "preact";
import { ENTRY_PATH } from "./app/entry/ask-to-enter";
import { registerServiceWorker } from "./app/page/register-service-worker";
import { Studio } from "./app/studio";
import { App } from "./app/ui/app";
import "./app/ui/styles/base.css";
import "./app/ui/styles/layout.css";
import "./app/ui/styles/bars.css";
import "./app/ui/styles/labels.css";
import "./app/ui/styles/status.css";
import "./app/ui/styles/tools.css";
import "./app/ui/styles/draw-modes.css";
import "./app/ui/styles/sheets.css";

const root = document.getElementById("app");
if (!root) {
  throw new Error("index.html has no element #app.");
}
if (location.pathname === ENTRY_PATH) {
  void import("./app/entry/entry-page").then(({ showEntry }) => showEntry(root));
} else {
  const studio = new Studio();
  // The server is asked first: it answers while the browser makes its picture ready.
  void studio.link.start();
  // Where it is silent, what it said last time holds.
  studio.rights.ask().catch(() => {});
  render(<App studio={studio} />, root);
  registerServiceWorker();
}
