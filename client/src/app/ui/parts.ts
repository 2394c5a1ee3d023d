import type { PanelName, SheetName } from "../page/layout";
import type { Studio } from "../studio";
import type { ToolLater } from "../tools/descriptor";
import { descriptorOf, laterOfAll, TOOL_NAMES, type ToolName } from "../tools/tools";
import { laterWordsIn } from "../words/later-words";
import { type Key, LANGUAGES } from "../words/say";
import { laterStyles, Part } from "./part";
import type { StudioView } from "./part-view";
import type { SheetSize } from "./sheets/sheet";

/** A card over the workspace, and about how high its content is. */
interface SheetPart {
  readonly title: Key;
  readonly size?: SheetSize;
  readonly height: string;
  readonly part: Part<StudioView>;
}

export const PANELS: Readonly<Record<PanelName, Part<StudioView>>> = {
  architecture: new Part(async () => (await import("./panels/architecture-panel")).ArchitecturePanel),
  brush: new Part(async () => (await import("./panels/brush-panel")).BrushPanel),
  leaves: new Part(async () => (await import("./panels/leaves-panel")).LeavesPanel),
  branches: new Part(async () => (await import("./panels/branches-panel")).BranchesPanel),
  background: new Part(async () => (await import("./panels/background-panel")).BackgroundPanel),
  wind: new Part(async () => (await import("./panels/wind-panel")).WindPanel),
  structure: new Part(async () => (await import("./panels/structure-panel")).StructurePanel),
  grammars: new Part(async () => (await import("./panels/grammars-panel")).GrammarsPanel),
  scene: new Part(async () => (await import("./panels/scene-panel")).ScenePanel),
  comments: new Part(async () => (await import("./panels/comments-panel")).CommentsPanel),
};

export const SHEETS: Readonly<Record<SheetName, SheetPart>> = {
  save: {
    title: "sheets.save",
    height: "12rem",
    part: new Part(async () => (await import("./sheets/save-sheet")).SaveSheet),
  },
  leave: {
    title: "sheets.leave",
    height: "16rem",
    part: new Part(async () => (await import("./sheets/leave-sheet")).LeaveSheet),
  },
  library: {
    title: "sheets.library",
    size: "page",
    height: "16rem",
    part: new Part(async () => (await import("./sheets/library/library-sheet")).LibrarySheet),
  },
  versions: {
    title: "sheets.versions",
    size: "page",
    height: "16rem",
    part: new Part(async () => (await import("./sheets/library/versions-sheet")).VersionsSheet),
  },
  share: {
    title: "sheets.share",
    height: "9rem",
    part: new Part(async () => (await import("./sheets/share/share-sheet")).ShareSheet),
  },
  gifts: {
    title: "sheets.gifts",
    size: "wide",
    height: "26rem",
    part: new Part(async () => (await import("./sheets/gifts/gifts-sheet")).GiftsSheet),
  },
  people: {
    title: "sheets.people",
    height: "14rem",
    part: new Part(async () => (await import("./sheets/people-sheet")).PeopleSheet),
  },
  accounts: {
    title: "sheets.accounts",
    size: "wide",
    height: "30rem",
    part: new Part(async () => (await import("./sheets/accounts/accounts-sheet")).AccountsSheet),
  },
  variations: {
    title: "sheets.variations",
    size: "wide",
    height: "22rem",
    part: new Part(async () => (await import("./sheets/variations/variations-sheet")).VariationsSheet),
  },
  download: {
    title: "sheets.download",
    height: "22rem",
    part: new Part(async () => (await import("./sheets/download-sheet")).DownloadSheet),
  },
  help: {
    title: "sheets.help",
    size: "wide",
    height: "46rem",
    // It is searched in every language.
    part: new Part(
      async () => {
        const [{ helpSheet }, tools] = await Promise.all([import("./sheets/help-sheet"), laterOfAll()]);
        return helpSheet(tools);
      },
      () => Promise.all([laterStyles(), ...LANGUAGES.map(laterWordsIn)]),
    ),
  },
  settings: {
    title: "sheets.settings",
    height: "20rem",
    part: new Part(async () => (await import("./sheets/settings-sheet")).SettingsSheet),
  },
};

/** What is shown while the tree is predicted. */
export const PREDICTION = new Part(() => import("./bars/prediction-bar"));

/** Options and marks of the tools, and what help says of them. */
export const TOOL_PARTS = Object.fromEntries(
  TOOL_NAMES.map((name) => [name, new Part(() => descriptorOf(name).later())]),
) as Readonly<Record<ToolName, Part<ToolLater>>>;

/** What is in progress and can be ended. */
export const CHIPS = new Part(async () => (await import("./notices/chips")).Chips);

/** Why the picture is coarse. It comes with texts of its own: it is said before a picture that takes long. */
/** The wind in the picture. */
export const WIND = new Part(
  async () => (await import("../document/wind/wind-of")).windOf,
  () => Promise.resolve(),
);

export const SLOWNESS = new Part(
  async () => (await import("./notices/slowness-chip")).SlownessChip,
  () => Promise.resolve(),
);

/** The draw modes, once their menu is opened. */
export const DRAW_MODE_LIST = new Part(async () => (await import("./bars/draw-mode-list")).DrawModeList);

/** What switches parts of the picture by key. */
export const SHOWN_SWITCH = new Part(async () => (await import("./bars/switch-shown")).switchShown);

/** What a draw mode shows, while the tree is not simply lit. */
export const DRAW_MODE_LEGEND = new Part(async () => (await import("./bars/draw-mode-legend")).DrawModeLegend);

/** The line of time, once anything was done. */
export const TIMELINE = new Part(async () => (await import("./timeline/timeline-strip")).TimelineStrip);

export const REPLAY = new Part(async () => (await import("./replay/replay-bar")).ReplayBar);

export const SYMMETRY = new Part(async () => (await import("./overlays/symmetry-mark")).SymmetryMark);

export const VAIN = new Part(async () => (await import("./overlays/vain-mark")).VainMark);

export const SUN = new Part(async () => (await import("./overlays/sun-handle")).SunHandle);

export const TOUR = new Part(async () => (await import("./notices/tour-card")).TourCard);

/** The name of the button that a finger is held on. */
export const NAMES = new Part(async () => (await import("./notices/button-label")).ButtonLabel);

/** Files that are dropped on the page. */
export const FILE_DROP = new Part(async () => (await import("./notices/file-drop")).FileDrop);

/** Others who have the tree open, once there are any. */
export const TOGETHER = new Part(() => import("./together/company"));

/** What people say of the tree, at its places. */
export const COMMENTS = new Part(async () => (await import("./comments/comment-pins")).CommentPins);

export const RECENT = new Part(async () => (await import("./notices/recent-trees")).RecentTrees);

/** All of them, those first that are needed first. */
const ALL: readonly Part<unknown>[] = [
  NAMES,
  CHIPS,
  TIMELINE,
  DRAW_MODE_LIST,
  SHOWN_SWITCH,
  DRAW_MODE_LEGEND,
  PREDICTION,
  ...Object.values(TOOL_PARTS),
  // Grammars come when they are opened, or stand in the tree.
  ...Object.entries(PANELS).flatMap(([name, part]) => (name === "grammars" ? [] : [part])),
  SYMMETRY,
  VAIN,
  SUN,
  TOGETHER,
  COMMENTS,
  RECENT,
  ...Object.values(SHEETS).map(({ part }) => part),
];

/** Loads every tool and part once the first tree is drawn and whenever the page is idle, so that none has to be waited for. */
export function loadPartsWhenIdle(studio: Studio, canvas: HTMLCanvasElement): () => void {
  let left = false;
  const loadAll = async () => {
    const tools = TOOL_NAMES.map((name) => () => studio.tools.load(name));
    const parts = ALL.map((part) => () => part.load());
    for (const load of [...tools, ...parts]) {
      await idle();
      if (left) {
        return;
      }
      await load();
    }
  };
  const drawn = new MutationObserver(() => {
    if (canvas.hasAttribute("data-still") && studio.rows.peek() > 0) {
      drawn.disconnect();
      void loadAll();
    }
  });
  drawn.observe(canvas, { attributeFilter: ["data-still"] });
  return () => {
    left = true;
    drawn.disconnect();
  };
}

/** Waits until the browser has nothing else to do; Safari does not say when. */
function idle(): Promise<void> {
  return new Promise((resolve) => {
    if ("requestIdleCallback" in window) {
      requestIdleCallback(() => resolve(), { timeout: 4000 });
    } else {
      setTimeout(resolve, 300);
    }
  });
}
