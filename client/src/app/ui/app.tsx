import { useEffect, useRef } from "preact/hooks";
import type { PanelName, SheetName, Studio } from "../studio";
import { BendMarks } from "./bend-marks";
import { BranchHandle } from "./branch-handle";
import { BudMarker, HoldRing } from "./bud-marker";
import { Chips } from "./chips";
import { CutLineMark } from "./cut-line-mark";
import { GrowthPanel } from "./growth-panel";
import { HelpSheet } from "./help-sheet";
import { LibrarySheet } from "./library-sheet";
import { HindranceCard, Hint, ToastList } from "./notices";
import { OutlineOverlay } from "./outline-overlay";
import { PredictionBar, PredictionMarks } from "./prediction-bar";
import { SaveSheet } from "./save-sheet";
import { ScenePanel } from "./scene-panel";
import { Seedlings } from "./seedling";
import { ShareSheet } from "./share-sheet";
import { SideBar } from "./side-bar";
import { Status } from "./status";
import { hasTimeline, TimelineStrip } from "./timeline-strip";
import { ToolOptions } from "./tool-options";
import { TopBar } from "./top-bar";
import { WidthRings } from "./width-rings";

const SHEETS: Record<SheetName, typeof SaveSheet> = {
  save: SaveSheet,
  library: LibrarySheet,
  share: ShareSheet,
  help: HelpSheet,
};

const PANELS: Record<PanelName, typeof GrowthPanel> = { growth: GrowthPanel, scene: ScenePanel };

/** The whole page: the workspace, and around it as little as possible. */
export function App({ studio }: { studio: Studio }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    if (!canvas.current) {
      return undefined;
    }
    const detach = studio.attach(canvas.current);
    void studio.start();
    return detach;
  }, [studio]);
  const sheet = studio.sheet.value;
  const Open = sheet === null ? null : SHEETS[sheet];
  const panel = studio.panel.value;
  const Pulled = panel === null ? null : PANELS[panel];
  return (
    <div
      class="app"
      data-side={studio.settings.side.value}
      data-drawing={studio.tools.drawing.value}
      data-panel={panel ?? undefined}
      data-timeline={hasTimeline(studio) ? "open" : undefined}
    >
      <canvas id="workspace" ref={canvas} aria-label="The tree. Draw to make it grow." role="img" />
      <Seedlings studio={studio} />
      <OutlineOverlay studio={studio} />
      <BudMarker studio={studio} />
      <BendMarks studio={studio} />
      <WidthRings studio={studio} />
      <CutLineMark studio={studio} />
      <PredictionMarks studio={studio} />
      <HoldRing studio={studio} />
      <SideBar studio={studio} />
      <TopBar studio={studio} />
      <BranchHandle studio={studio} />
      {Pulled !== null && <Pulled studio={studio} />}
      <PredictionBar studio={studio} />
      <ToolOptions studio={studio} />
      <Chips studio={studio} />
      <Status studio={studio} />
      <Hint studio={studio} />
      <TimelineStrip studio={studio} />
      <HindranceCard studio={studio} />
      <ToastList studio={studio} />
      {Open !== null && <Open studio={studio} />}
    </div>
  );
}
