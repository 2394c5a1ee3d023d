import type { ComponentType } from "preact";
import { useRef, useState } from "preact/hooks";
import type { Rights } from "../../access/rights";
import type { PlaceName } from "../../help/help-places";
import { PANEL_NAMES, type SheetName } from "../../page/layout";
import type { Studio } from "../../studio";
import { type Key, say } from "../../words/say";
import {
  ArchitectureIcon,
  BackgroundIcon,
  BarkIcon,
  BrushIcon,
  CommentIcon,
  DownloadIcon,
  GrammarIcon,
  HelpIcon,
  HideIcon,
  LeafIcon,
  LibraryIcon,
  MoreIcon,
  NewIcon,
  SaveIcon,
  SceneIcon,
  SettingsIcon,
  ShareIcon,
  StructureIcon,
  WindIcon,
} from "../icons";
import { useDismissal } from "../use-dismissal";
import { isToolBarFolded, roomOfToolBar } from "../workspace-size";
import { DrawModeMenu } from "./draw-mode-menu";

/** A panel that the bar has a button of its own for. */
type BarPanel = (typeof PANEL_NAMES)[number];

const PANEL_ICONS: Record<BarPanel, ComponentType> = {
  architecture: ArchitectureIcon,
  brush: BrushIcon,
  leaves: LeafIcon,
  branches: BarkIcon,
  background: BackgroundIcon,
  wind: WindIcon,
  structure: StructureIcon,
  grammars: GrammarIcon,
  scene: SceneIcon,
};

interface ToolAction {
  readonly label: Key;
  /** What help calls it. */
  readonly place?: PlaceName;
  readonly title?: Key;
  readonly Icon: ComponentType;
  /** Whether somebody may who has these rights; everybody if absent. */
  readonly may?: (rights: Rights) => boolean;
  readonly act: (studio: Studio) => void;
}

const sheet = (name: SheetName) => (studio: Studio) => {
  studio.layout.sheet.value = name;
};

const COMMENTS = "panels.comments";

/** What is done with the page and with a tree as a whole. */
const TOOL_ACTIONS: readonly ToolAction[] = [
  {
    label: "bars.hide",
    place: "hide",
    title: "bars.hide.title",
    Icon: HideIcon,
    act: (studio) => {
      studio.layout.bare.value = true;
    },
  },
  {
    label: "bars.new",
    place: "new",
    Icon: NewIcon,
    may: (rights) => rights.mayBegin,
    act: (studio) => studio.trees.begin(),
  },
  { label: "bars.save", Icon: SaveIcon, may: (rights) => rights.mayChange.value, act: sheet("save") },
  { label: "bars.library", Icon: LibraryIcon, act: sheet("library") },
  { label: "bars.share", Icon: ShareIcon, act: sheet("share") },
  { label: COMMENTS, Icon: CommentIcon, act: (studio) => studio.layout.togglePanel("comments") },
  { label: "bars.download", Icon: DownloadIcon, act: sheet("download") },
  { label: "bars.settings", Icon: SettingsIcon, act: sheet("settings") },
  { label: "bars.help", title: "bars.help.title", Icon: HelpIcon, act: sheet("help") },
];

/** What the bar has beside the panels where it is folded: the draw modes and the menu. */
const BESIDE_PANELS = 2;

/** The panels, and what is done with a tree as a whole; where room is short the latter, and the last panels, fold into a menu. */
export function ToolBar({ studio }: { studio: Studio }) {
  const mayChange = studio.rights.mayChange.value;
  // What is left for who only looks has room anywhere.
  const names = studio.settings.namesShown.value;
  const folded = mayChange && isToolBarFolded(names);
  const room = mayChange ? (folded ? roomOfToolBar(names) - BESIDE_PANELS : PANEL_NAMES.length) : 0;
  const actions = TOOL_ACTIONS.filter(({ may }) => may?.(studio.rights) ?? true);
  return (
    <header class="panel tool-bar" data-folded={folded}>
      {PANEL_NAMES.slice(0, room).map((panel) => {
        const Icon = PANEL_ICONS[panel];
        return (
          <button
            type="button"
            class="tool"
            key={panel}
            aria-label={say(`panels.${panel}`)}
            title={say(`panels.${panel}`)}
            aria-pressed={studio.layout.panel.value === panel}
            onClick={() => studio.layout.togglePanel(panel)}
          >
            <Icon />
          </button>
        );
      })}
      {mayChange && <hr />}
      <DrawModeMenu studio={studio} />
      {folded ? (
        <Menu studio={studio} panels={PANEL_NAMES.slice(room)} actions={actions} />
      ) : (
        actions.map(({ label, place, title = label, Icon, act }) => (
          <button
            type="button"
            class="tool"
            key={label}
            data-place={place}
            aria-label={say(label)}
            title={say(title)}
            aria-description={label === COMMENTS ? news(studio)?.text : undefined}
            onClick={() => act(studio)}
          >
            <Icon />
            {label === COMMENTS && <Unread studio={studio} />}
          </button>
        ))
      )}
    </header>
  );
}

/** What was said and not seen by whoever is here; null for nothing, or where nobody knows yet. */
function news({ comments }: Studio) {
  return comments.conversation.value?.news.value ?? null;
}

/** How much that is, on the button that leads there; in another colour where some of it is for whoever is here. */
function Unread({ studio }: { readonly studio: Studio }) {
  const unread = news(studio);
  return (
    unread && (
      <span class="unread" data-me={unread.isForMe} aria-hidden="true">
        {unread.isForMe ? "@" : Math.min(unread.count, 99)}
      </span>
    )
  );
}

interface MenuProps {
  readonly studio: Studio;
  readonly panels: readonly BarPanel[];
  readonly actions: readonly ToolAction[];
}

function Menu({ studio, panels, actions }: MenuProps) {
  const host = useRef<HTMLDivElement>(null);
  const [open, setOpen] = useState(false);
  useDismissal(host, open, () => setOpen(false));
  return (
    <div class="more" ref={host}>
      <button
        type="button"
        class="tool"
        data-place="more"
        aria-label={say("bars.more")}
        title={say("bars.more")}
        aria-description={news(studio)?.text}
        aria-expanded={open}
        onClick={() => setOpen(!open)}
      >
        <MoreIcon />
        <Unread studio={studio} />
      </button>
      {open && (
        <ul class="panel menu" aria-label={say("bars.more")}>
          {[...panels.map(asAction), ...actions].map(({ label, Icon, act }) => (
            <li key={label}>
              <button
                type="button"
                aria-description={label === COMMENTS ? news(studio)?.text : undefined}
                onClick={() => {
                  setOpen(false);
                  act(studio);
                }}
              >
                <Icon />
                {say(label)}
                {label === COMMENTS && <Unread studio={studio} />}
              </button>
            </li>
          ))}
        </ul>
      )}
    </div>
  );
}

function asAction(panel: BarPanel): ToolAction {
  return {
    label: `panels.${panel}`,
    Icon: PANEL_ICONS[panel],
    act: (studio) => studio.layout.togglePanel(panel),
  };
}
