import type { ComponentType } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { followChoices } from "../page/language-and-theme";
import type { PanelName, SheetName, Studio } from "../studio";
import { say } from "../words/say";
import { attachWorkspace } from "../workspace";
import { DrawModeLegend } from "./bars/draw-mode-legend";
import { PredictionBar, PredictionMarks } from "./bars/prediction-bar";
import { RotationStrip } from "./bars/rotation-strip";
import { ShowAll } from "./bars/show-all";
import { SideBar } from "./bars/side-bar";
import { ToolBar } from "./bars/tool-bar";
import { ToolOptions } from "./bars/tool-options";
import { Chips } from "./notices/chips";
import { HindranceCard, Hint, ToastList } from "./notices/notices";
import { Status } from "./notices/status";
import { TourCard } from "./notices/tour-card";
import { BendMarks } from "./overlays/bend-marks";
import { BranchHandle } from "./overlays/branch-handle";
import { BudMarker, HoldRing } from "./overlays/bud-marker";
import { CutLineMark } from "./overlays/cut-line-mark";
import { OutlineOverlay } from "./overlays/outline-overlay";
import { Seedlings } from "./overlays/seedling";
import { SunHandle } from "./overlays/sun-handle";
import { WidthRings } from "./overlays/width-rings";
import { ArchitecturePanel } from "./panels/architecture-panel";
import { BackgroundPanel } from "./panels/background-panel";
import { BranchesPanel } from "./panels/branches-panel";
import { BrushPanel } from "./panels/brush-panel";
import { LeavesPanel } from "./panels/leaves-panel";
import { ScenePanel } from "./panels/scene-panel";
import { HelpSheet } from "./sheets/help-sheet";
import { LibrarySheet } from "./sheets/library-sheet";
import { SaveSheet } from "./sheets/save-sheet";
import { SettingsSheet } from "./sheets/settings-sheet";
import { ShareSheet } from "./sheets/share-sheet";
import { hasTimeline, TimelineStrip } from "./timeline/timeline-strip";
import { useRoom } from "./workspace-size";

const SHEETS: Record<SheetName, ComponentType<{ studio: Studio }>> = {
  save: SaveSheet,
  library: LibrarySheet,
  share: ShareSheet,
  help: HelpSheet,
  settings: SettingsSheet,
};

const PANELS: Record<PanelName, ComponentType<{ studio: Studio }>> = {
  architecture: ArchitecturePanel,
  brush: BrushPanel,
  leaves: LeavesPanel,
  branches: BranchesPanel,
  background: BackgroundPanel,
  scene: ScenePanel,
};

/** The whole page: the workspace, around it as little as possible, and beside it the panel that is pulled down. */
export function App({ studio }: { studio: Studio }) {
  const sheet = studio.sheet.value;
  const Open = sheet === null ? null : SHEETS[sheet];
  const bare = studio.bare.value;
  const panel = bare ? null : studio.panel.value;
  const Pulled = panel === null ? null : PANELS[panel];
  return (
    <div
      class="app"
      data-side={studio.settings.side.value}
      data-drawing={studio.tools.drawing.value}
      data-panel={panel ?? undefined}
      data-bare={bare}
    >
      <Workspace studio={studio} />
      {Pulled !== null && <Pulled studio={studio} />}
      <ToastList studio={studio} />
      {Open !== null && <Open studio={studio} />}
    </div>
  );
}

/** The picture with what lies over it; it shrinks beside a panel and stays in use. */
function Workspace({ studio }: { studio: Studio }) {
  const [host, canvas] = [useRef<HTMLElement>(null), useRef<HTMLCanvasElement>(null)];
  useRoom(host);
  useEffect(() => followChoices(studio.settings), [studio]);
  useEffect(() => studio.tour.follow(), [studio]);
  useEffect(() => {
    if (!canvas.current) {
      return undefined;
    }
    return attachWorkspace(studio, canvas.current);
  }, [studio]);
  return (
    <main
      class="workspace"
      ref={host}
      data-timeline={hasTimeline(studio) ? "open" : undefined}
      data-tour={studio.tour.step.value ?? undefined}
    >
      <canvas id="workspace" ref={canvas} aria-label={say("notices.workspace")} role="img" />
      <Seedlings studio={studio} />
      <OutlineOverlay studio={studio} />
      <BudMarker studio={studio} />
      <BendMarks studio={studio} />
      <WidthRings studio={studio} />
      <CutLineMark studio={studio} />
      <PredictionMarks studio={studio} />
      <HoldRing studio={studio} />
      <BranchHandle studio={studio} />
      {studio.bare.value ? <ShowAll studio={studio} /> : <Bars studio={studio} />}
      <SunHandle studio={studio} />
      <PredictionBar studio={studio} />
      <HindranceCard studio={studio} />
    </main>
  );
}

/** What stands along the edges of the workspace. */
function Bars({ studio }: { studio: Studio }) {
  return (
    <>
      <ToolBar studio={studio} />
      <SideBar studio={studio} />
      <ToolOptions studio={studio} />
      <Status studio={studio} />
      <Hint studio={studio} />
      <div class="foot">
        <RotationStrip studio={studio} />
        <TimelineStrip studio={studio} />
      </div>
      <TourCard studio={studio} />
      <Chips studio={studio} />
      <DrawModeLegend studio={studio} />
    </>
  );
}
