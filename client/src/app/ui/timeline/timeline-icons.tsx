import type { ComponentType } from "preact";
import type { OperationKind } from "../../../wire/generated";
import type { Key } from "../../words/say";
import { BoxIcon, GrammarIcon, GrowthIcon, Icon, LassoIcon, NewIcon, RedoIcon, SeedIcon, UndoIcon } from "../icons";
import { BendIcon, GraftIcon, PruneIcon, TurnIcon, WidthIcon } from "../shaping-icons";

/** A stroke with the brush at its end. */
const StrokeIcon = () => (
  <Icon>
    <path d="M5 20c4.5-1 2.5-6.5 6-8.5 2-1.2 3.5-.5 4.5-2" />
    <circle cx="16.5" cy="7" r="3.2" />
  </Icon>
);

/** A leaf in its own colour. */
const LookIcon = () => (
  <Icon>
    <path d="M5.5 19c-1.5-7.5 3-13 13.5-14 .5 10-5 15-13.5 14Z" />
    <path d="M4 20.5 13 11" />
  </Icon>
);

/** An outline with what it holds. */
const DesignIcon = () => (
  <Icon>
    <path d="M12 3.5c4.5 3 6.5 6 6.5 9.2 0 2.6-2.6 4.3-6.5 4.3s-6.5-1.7-6.5-4.3c0-3.2 2-6.2 6.5-9.2Z" />
    <path d="M12 20.5v-11M12 14l3-2.5M12 12.5l-2.5-2" />
  </Icon>
);

/** A limb that leads into an outline beside it. */
const RefillIcon = () => (
  <Icon>
    <path d="M5 20.5V9M5 16l4.5-3.2" />
    <path d="M9.5 12.8c0-4 2.2-7.3 5.5-7.3s5 3 5 6.3-2.4 5.7-5.5 5.7-5-1.8-5-4.7Z" />
    <path d="m12.5 12 4.5-2.5M14.5 11l2 2.5" />
  </Icon>
);

interface Sort {
  readonly name: Key;
  readonly Icon: ComponentType;
}

const SORTS: Record<OperationKind, Sort> = {
  stroke: { name: "operations.kind.stroke", Icon: StrokeIcon },
  growth: { name: "operations.kind.growth", Icon: NewIcon },
  lasso: { name: "operations.kind.lasso", Icon: LassoIcon },
  parameters: { name: "operations.kind.parameters", Icon: GrowthIcon },
  appearance: { name: "operations.kind.appearance", Icon: LookIcon },
  seed: { name: "operations.kind.seed", Icon: SeedIcon },
  obstacle: { name: "operations.kind.obstacle", Icon: BoxIcon },
  bend: { name: "operations.kind.bend", Icon: BendIcon },
  width: { name: "operations.kind.width", Icon: WidthIcon },
  prune: { name: "operations.kind.prune", Icon: PruneIcon },
  turn: { name: "operations.kind.turn", Icon: TurnIcon },
  graft: { name: "operations.kind.graft", Icon: GraftIcon },
  taken_back: { name: "operations.kind.taken_back", Icon: UndoIcon },
  design: { name: "operations.kind.design", Icon: DesignIcon },
  grammar: { name: "operations.kind.grammar", Icon: GrammarIcon },
  refill: { name: "operations.kind.refill", Icon: RefillIcon },
  brought_back: { name: "operations.kind.brought_back", Icon: RedoIcon },
};

/** What an operation is called and looks like. */
export function sortOf(kind: OperationKind): Sort {
  return SORTS[kind];
}

/** A line of time that parts in two. */
export const ForkIcon = () => (
  <Icon>
    <path d="M3.5 17H10c5 0 4.5-9.5 10-9.5M10 17h10.5" />
    <path d="m17.5 4.8 2.7 2.7-2.7 2.7" />
  </Icon>
);

export const TimeIcon = () => (
  <Icon>
    <path d="M5.2 8.3A7.8 7.8 0 1 1 4.2 12" />
    <path d="M4.5 4.3v4.2h4.2M12 7.8V12l3 2" />
  </Icon>
);

export const BackIcon = () => (
  <Icon>
    <path d="m14.5 6-6 6 6 6" />
  </Icon>
);

export const ForthIcon = () => (
  <Icon>
    <path d="m9.5 6 6 6-6 6" />
  </Icon>
);

export const PlayIcon = () => (
  <Icon>
    <path d="M8 5.5v13l10.5-6.5Z" />
  </Icon>
);

export const PauseIcon = () => (
  <Icon>
    <path d="M8.5 5.5v13M15.5 5.5v13" />
  </Icon>
);

/** A strip of film. */
export const FilmIcon = () => (
  <Icon>
    <path d="M4.5 5.5h15v13h-15ZM8.5 5.5v13M15.5 5.5v13M4.5 10h4M4.5 14.2h4M15.5 10h4M15.5 14.2h4" />
  </Icon>
);

export const FoldIcon = () => (
  <Icon>
    <path d="m6 9.5 6 6 6-6" />
  </Icon>
);
