import { render } from "preact";
import { Studio } from "./app/studio";
import { App } from "./app/ui/app";
import "./app/ui/styles/base.css";
import "./app/ui/styles/bars.css";
import "./app/ui/styles/status.css";
import "./app/ui/styles/tools.css";
import "./app/ui/styles/shaping.css";
import "./app/ui/styles/panels.css";
import "./app/ui/styles/timeline.css";
import "./app/ui/styles/branch.css";
import "./app/ui/styles/sheets.css";

const root = document.getElementById("app");
if (!root) {
  throw new Error("index.html has no element #app.");
}
render(<App studio={new Studio()} />, root);
