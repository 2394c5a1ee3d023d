import { Icon } from "./icons";

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
