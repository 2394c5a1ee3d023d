import { useEffect, useRef, useState } from "preact/hooks";
import { listenForHolds, type NamedControl } from "../input/button-holds";
import { followChoices } from "../page/language-and-theme";
import type { Studio } from "../studio";
import { symmetryNow } from "../tools/symmetry/stroke-copies";
import { descriptorOf } from "../tools/tools";
import { say } from "../words/say";
import { attachWorkspace } from "../workspace";
import { RotationStrip } from "./bars/rotation-strip";
import { ShowAll } from "./bars/show-all";
import { SideBar } from "./bars/side-bar";
import { ToolBar } from "./bars/tool-bar";
import { HindranceCard, Hint, ToastList } from "./notices/notices";
import { Status } from "./notices/status";
import { BudMarker, HoldRing } from "./overlays/bud-marker";
import { OutlineOverlay } from "./overlays/outline-overlay";
import { Seedlings } from "./overlays/seedling";
import { StrokeGhosts } from "./overlays/stroke-ghost";
import { Panel } from "./panels/panel";
import type { Part } from "./part";
import { PartView } from "./part-view";
import {
  CHIPS,
  COMMENTS,
  DRAW_MODE_LEGEND,
  FILE_DROP,
  loadPartsWhenIdle,
  NAMES,
  PANELS,
  PREDICTION,
  RECENT,
  REPLAY,
  SHEETS,
  SLOWNESS,
  SUN,
  SYMMETRY,
  TIMELINE,
  TOGETHER,
  TOOL_PARTS,
  TOUR,
  VAIN,
} from "./parts";
import { Sheet } from "./sheets/sheet";
import { hasTimeline, isWorthShowing } from "./timeline/has-timeline";
import { useWorkspaceSize } from "./workspace-size";

/** The whole page: the workspace, around it as little as possible, and beside it the panel that is pulled down. */
export function App({ studio }: { studio: Studio }) {
  const sheet = studio.layout.sheet.value;
  const shown = sheet === null ? null : SHEETS[sheet];
  const bare = studio.layout.bare.value;
  const FileDrop = usePart(studio, FILE_DROP, studio.rights.mayBegin);
  const pulled = studio.layout.panel.value;
  const panel = bare || (pulled !== "comments" && !studio.rights.mayChange.value) ? null : pulled;
  return (
    <div
      class="app"
      data-side={studio.settings.side.value}
      data-names={studio.settings.namesShown.value}
      data-drawing={studio.tools.drawing.value}
      data-panel={panel ?? undefined}
      data-bare={bare}
    >
      <Workspace studio={studio} />
      {panel !== null && (
        <Panel studio={studio} title={say(`panels.${panel}`)} key={panel}>
          <PartView studio={studio} part={PANELS[panel]} />
        </Panel>
      )}
      {shown === null && <ToastList studio={studio} />}
      <HeldName studio={studio} />
      {FileDrop && studio.rights.mayBegin && <FileDrop studio={studio} />}
      {shown !== null && (
        <Sheet studio={studio} title={say(shown.title)} size={shown.size} key={sheet}>
          <PartView studio={studio} part={shown.part} height={shown.height} />
        </Sheet>
      )}
    </div>
  );
}

/** The name of the button that a finger is held on; whoever asks for it does not wait for the first picture. */
function HeldName({ studio }: { studio: Studio }) {
  const [control, hold] = useState<NamedControl | null>(null);
  useEffect(() => listenForHolds(hold), []);
  const ButtonLabel = usePart(studio, NAMES, control !== null, true);
  return ButtonLabel && <ButtonLabel control={control} />;
}

/** The picture with what lies over it; it shrinks beside a panel and stays in use. */
function Workspace({ studio }: { studio: Studio }) {
  const [host, canvas] = [useRef<HTMLElement>(null), useRef<HTMLCanvasElement>(null)];
  useWorkspaceSize(host);
  useEffect(() => followChoices(studio.settings, () => studio.toasts.show(say("notices.part-lost"))), [studio]);
  useEffect(() => (canvas.current ? loadPartsWhenIdle(studio, canvas.current) : undefined), [studio]);
  useEffect(() => studio.tour.follow(), [studio]);
  useEffect(() => {
    if (!canvas.current) {
      return undefined;
    }
    return attachWorkspace(studio, canvas.current);
  }, [studio]);
  const tool = useToolViews(studio);
  const company = usePart(studio, TOGETHER, (studio.document.value?.people ?? 1) > 1 || studio.link.replaying.value);
  const CommentPins = usePart(studio, COMMENTS, hasComments(studio));
  const prediction = usePart(studio, PREDICTION, studio.branches.prediction.rows.value !== null);
  const repeats = descriptorOf(studio.tools.chosen.value).isSymmetric === true && isRepeating(studio);
  const SymmetryMark = usePart(studio, SYMMETRY, repeats);
  const VainMark = usePart(studio, VAIN, studio.drawnInVain.shown.value !== null);
  const SunHandle = usePart(studio, SUN, studio.sunPinned.value || studio.layout.panel.value === "background");
  return (
    <main
      class="workspace"
      ref={host}
      data-timeline={hasTimeline(studio) ? "open" : undefined}
      data-tour={studio.tour.step.value ?? undefined}
    >
      <canvas id="workspace" ref={canvas} aria-label={say("notices.workspace")} role="img" />
      {/* Below what stands at places of the tree. */}
      {(studio.link.replaying.value || !studio.layout.bare.value) && <Status studio={studio} />}
      <Seedlings studio={studio} />
      {repeats && SymmetryMark && <SymmetryMark studio={studio} />}
      <StrokeGhosts studio={studio} />
      <OutlineOverlay studio={studio} />
      <BudMarker studio={studio} />
      {tool?.views.Marks && <tool.views.Marks tool={tool.made} page={studio} />}
      {prediction && <prediction.PredictionMarks studio={studio} />}
      <HoldRing studio={studio} />
      {CommentPins && hasComments(studio) && <CommentPins studio={studio} />}
      {company && <company.Company studio={studio} />}
      {VainMark && <VainMark studio={studio} />}
      {studio.link.replaying.value ? (
        <ReplayBars studio={studio} />
      ) : studio.layout.bare.value ? (
        <ShowAll studio={studio} />
      ) : (
        <Bars studio={studio} />
      )}
      {SunHandle && <SunHandle studio={studio} />}
      {prediction && <prediction.PredictionBar studio={studio} />}
      <HindranceCard studio={studio} />
    </main>
  );
}

/** Whether anything may be said of the tree, as far as it is known. */
function hasComments({ comments, layout, link }: Studio): boolean {
  return (
    comments.pins.value.size > 0 ||
    comments.stale.value.size > 0 ||
    layout.panel.value === "comments" ||
    // Of what was said of the tree as a whole no pin tells.
    (link.phase.value === "connected" && !link.replaying.value) ||
    comments.conversation.value !== null
  );
}

function isRepeating({ settings, bud }: Studio): boolean {
  return symmetryNow(settings, bud.row.value).kind !== "off";
}

/** Options and marks of the chosen tool, and the tool; null until they are there. */
function useToolViews(studio: Studio) {
  const name = studio.tools.chosen.value;
  const views = usePart(studio, TOOL_PARTS[name], descriptorOf(name).hasViews === true && name);
  const made = studio.tools.made.value?.[name];
  return views && made ? { views, made } : null;
}

/**
 * A part that has no place for a sentence of its own, asked for whenever `need` becomes another; null until it is there.
 * The first picture goes before it, unless it is wanted at once or something keeps that picture from coming.
 */
function usePart<Content>(studio: Studio, part: Part<Content>, need: string | boolean, atOnce = false): Content | null {
  const mayCome = atOnce || studio.stage.opened.value || studio.hindrance.value !== null;
  useEffect(() => {
    if (mayCome && need !== false) {
      void part.open().then(() => {
        const failure = part.failure.peek();
        if (failure !== null) {
          studio.toasts.show(say(`notices.part-${failure}`));
        }
      });
    }
  }, [studio, part, need, mayCome]);
  return part.content.value;
}

/** What stands along the edges of the workspace. */
function Bars({ studio }: { studio: Studio }) {
  const name = studio.tools.chosen.value;
  const Options = TOOL_PARTS[name].content.value?.Options;
  const made = studio.tools.made.value?.[name];
  const predicted = studio.branches.prediction.rows.value !== null;
  const TourCard = usePart(studio, TOUR, studio.tour.step.value !== null);
  const TimelineStrip = usePart(studio, TIMELINE, isWorthShowing(studio.time.timeline.value));
  const Chips = usePart(studio, CHIPS, studio.document.value !== null);
  const company = TOGETHER.content.value;
  const Slowness = usePart(studio, SLOWNESS, studio.stage.cardless.value || studio.slowness.value !== null, true);
  const DrawModeLegend = usePart(studio, DRAW_MODE_LEGEND, studio.drawMode.value !== "lit");
  const mayChange = studio.rights.mayChange.value;
  const isFirst = isFirstScreen(studio);
  const RecentTrees = usePart(studio, RECENT, isFirst);
  return (
    <>
      <ToolBar studio={studio} />
      <SideBar studio={studio} />
      {mayChange && Options && made && !predicted && <Options tool={made} page={studio} />}
      <Hint studio={studio} />
      <div class="foot">
        <RotationStrip studio={studio} />
        {TimelineStrip && <TimelineStrip studio={studio} />}
      </div>
      {TourCard && <TourCard studio={studio} />}
      {RecentTrees && isFirst && mayChange && <RecentTrees studio={studio} />}
      <div class="chips" role="status">
        {Chips && <Chips studio={studio} />}
        {Slowness && <Slowness studio={studio} />}
        {company && <company.CompanyChips studio={studio} />}
      </div>
      {DrawModeLegend && <DrawModeLegend studio={studio} />}
    </>
  );
}

/** What stands there while a design is played. */
function ReplayBars({ studio }: { studio: Studio }) {
  const ReplayBar = usePart(studio, REPLAY, true, true);
  const Chips = usePart(studio, CHIPS, true);
  return (
    <>
      <div class="foot">
        <RotationStrip studio={studio} />
        {ReplayBar && <ReplayBar studio={studio} />}
      </div>
      <div class="chips" role="status">
        {Chips && <Chips studio={studio} />}
      </div>
    </>
  );
}

/** Whether nothing has been done on the page yet, and nothing else wants to be looked at. */
function isFirstScreen({ document, hindrance, tools, tour, settings, layout }: Studio): boolean {
  return (
    document.value?.metamers === 0 &&
    !document.value.can_undo &&
    !document.value.can_redo &&
    hindrance.value === null &&
    !tools.drawing.value &&
    settings.tourSeen.value &&
    tour.step.value === null &&
    layout.panel.value === null
  );
}
