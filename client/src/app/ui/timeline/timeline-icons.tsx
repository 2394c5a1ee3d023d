import type { ComponentType } from "preact";
import type { OperationKind } from "../../../wire/generated";
import type { Key } from "../../words/say";
import { BoxIcon, GrowthIcon, Icon, LassoIcon, NewIcon, SeedIcon } from "../icons";

/** A stroke with the brush at its end. */
const StrokeIcon = () => (
  <Icon>
    <path d="M5 20c4.5-1 2.5-6.5 6-8.5 2-1.2 3.5-.5 4.5-2" />
    <circle cx="16.5" cy="7" r="3.2" />
  </Icon>
);

/** A limb bent over, with the finger's dot. */
export const BendIcon = () => (
  <Icon>
    <path d="M6 20.5c0-8 2-12 9-13.5" />
    <circle cx="17.5" cy="6.5" r="2" fill="currentColor" />
    <path d="M6 20.5V7.5" stroke-dasharray="1.5 3.2" />
  </Icon>
);

/** A limb between two arrows. */
export const WidthIcon = () => (
  <Icon>
    <path d="M9.5 4v16M14.5 4v16" />
    <path d="M2.5 12H7M5 9.8 7.2 12 5 14.2M21.5 12H17M19 9.8 16.8 12l2.2 2.2" />
  </Icon>
);

export const PruneIcon = () => (
  <Icon>
    <circle cx="7" cy="18" r="2.5" />
    <circle cx="17" cy="18" r="2.5" />
    <path d="M8.3 15.8 15.5 4M15.7 15.8 8.5 4" />
  </Icon>
);

/** A branch and the way it turns. */
export const TurnIcon = () => (
  <Icon>
    <path d="M12 20v-8M12 12l4.5-4.5" />
    <path d="M6.5 13.5a7 7 0 1 1 12.6-1.5" />
    <path d="m4.3 10.8 2.2 3 3-2.2" />
  </Icon>
);

/** A scion set on a limb. */
export const GraftIcon = () => (
  <Icon>
    <path d="M7 20.5v-17M7 14.5l6-4.5" />
    <path d="M16.5 7.5c3.5-.2 4.7-1.8 4.5-4.5-3.2-.1-4.8 1.5-4.5 4.5ZM16.5 7.5 13 10" />
    <path d="M15 13.5v5M12.5 16h5" />
  </Icon>
);

/** A leaf in its own colour. */
const LookIcon = () => (
  <Icon>
    <path d="M5.5 19c-1.5-7.5 3-13 13.5-14 .5 10-5 15-13.5 14Z" />
    <path d="M4 20.5 13 11" />
  </Icon>
);

interface Sort {
  readonly name: Key;
  readonly Icon: ComponentType;
}

const SORTS: Record<OperationKind, Sort> = {
  stroke: { name: "timeline.kind.stroke", Icon: StrokeIcon },
  growth: { name: "timeline.kind.growth", Icon: NewIcon },
  lasso: { name: "timeline.kind.lasso", Icon: LassoIcon },
  parameters: { name: "timeline.kind.parameters", Icon: GrowthIcon },
  appearance: { name: "timeline.kind.appearance", Icon: LookIcon },
  seed: { name: "timeline.kind.seed", Icon: SeedIcon },
  obstacle: { name: "timeline.kind.obstacle", Icon: BoxIcon },
  bend: { name: "timeline.kind.bend", Icon: BendIcon },
  width: { name: "timeline.kind.width", Icon: WidthIcon },
  prune: { name: "timeline.kind.prune", Icon: PruneIcon },
  turn: { name: "timeline.kind.turn", Icon: TurnIcon },
  graft: { name: "timeline.kind.graft", Icon: GraftIcon },
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

export const FoldIcon = () => (
  <Icon>
    <path d="m6 9.5 6 6 6-6" />
  </Icon>
);
