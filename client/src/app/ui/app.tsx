import type { ComponentType } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { followChoices } from "../looks";
import type { PanelName, SheetName, Studio } from "../studio";
import { say } from "../words";
import { attachWorkspace } from "../workspace";
import { ArchitecturePanel } from "./architecture-panel";
import { BackgroundPanel } from "./background-panel";
import { BendMarks } from "./bend-marks";
import { BranchHandle } from "./branch-handle";
import { BranchesPanel } from "./branches-panel";
import { BrushPanel } from "./brush-panel";
import { BudMarker, HoldRing } from "./bud-marker";
import { Chips } from "./chips";
import { CutLineMark } from "./cut-line-mark";
import { DrawModeLegend } from "./draw-mode-legend";
import { HelpSheet } from "./help-sheet";
import { LeavesPanel } from "./leaves-panel";
import { LibrarySheet } from "./library-sheet";
import { HindranceCard, Hint, ToastList } from "./notices";
import { OutlineOverlay } from "./outline-overlay";
import { PredictionBar, PredictionMarks } from "./prediction-bar";
import { useRoom } from "./room";
import { RotationStrip } from "./rotation-strip";
import { SaveSheet } from "./save-sheet";
import { ScenePanel } from "./scene-panel";
import { Seedlings } from "./seedling";
import { SettingsSheet } from "./settings-sheet";
import { ShareSheet } from "./share-sheet";
import { ShowAll } from "./show-all";
import { SideBar } from "./side-bar";
import { Status } from "./status";
import { SunHandle } from "./sun-handle";
import { hasTimeline, TimelineStrip } from "./timeline-strip";
import { ToolBar } from "./tool-bar";
import { ToolOptions } from "./tool-options";
import { TourCard } from "./tour-card";
import { WidthRings } from "./width-rings";

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
