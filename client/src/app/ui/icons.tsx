import type { ComponentChildren } from "preact";

export function Icon({ children }: { children: ComponentChildren }) {
  return (
    <svg
      class="icon"
      viewBox="0 0 24 24"
      fill="none"
      stroke="currentColor"
      stroke-width="1.7"
      stroke-linecap="round"
      stroke-linejoin="round"
      aria-hidden="true"
    >
      {children}
    </svg>
  );
}

/** A tree within its outline. */
export const StructureIcon = () => (
  <Icon>
    <path d="M12 3c5 3.2 7 6.3 7 9.5 0 2.7-2.8 4.5-7 4.5s-7-1.8-7-4.5C5 9.3 7 6.2 12 3Z" />
    <path d="M12 21V9M12 14.5l3.2-2.7M12 12.5 9.3 10" />
  </Icon>
);

export const WindIcon = () => (
  <Icon>
    <path d="M3 9h11a3 3 0 1 0-3-3M3 13h15a3 3 0 1 1-3 3M3 17h6" />
  </Icon>
);

export const UndoIcon = () => (
  <Icon>
    <path d="M8.5 5 4.5 9l4 4" />
    <path d="M4.5 9h9a6 6 0 0 1 0 12H9" transform="translate(0 -1.5)" />
  </Icon>
);

export const RedoIcon = () => (
  <Icon>
    <path d="m15.5 5 4 4-4 4" />
    <path d="M19.5 9h-9a6 6 0 0 0 0 12H15" transform="translate(0 -1.5)" />
  </Icon>
);

export const FrameIcon = () => (
  <Icon>
    <path d="M4 8.5V5.5A1.5 1.5 0 0 1 5.5 4h3M15.5 4h3A1.5 1.5 0 0 1 20 5.5v3M20 15.5v3a1.5 1.5 0 0 1-1.5 1.5h-3M8.5 20h-3A1.5 1.5 0 0 1 4 18.5v-3" />
    <path d="M12 16.5v-5M12 13.2c-2.6 0-3.6-1.6-3.6-3.3 0-1.4 1.5-2.7 3.6-2.7s3.6 1.3 3.6 2.7c0 1.7-1 3.3-3.6 3.3Z" />
  </Icon>
);

export const NewIcon = () => (
  <Icon>
    <path d="M12 20.5v-9" />
    <path d="M12 13.5c-4 .2-6.3-1.7-6.6-5.4C9.4 7.9 11.7 9.8 12 13.5Z" />
    <path d="M12 11.5c-.1-4 2-6.6 6.2-7 .2 4.2-2 6.7-6.2 7Z" />
    <path d="M7 20.5h10" />
  </Icon>
);

export const SaveIcon = () => (
  <Icon>
    <path d="M4.5 4.5h12l3 3v12h-15ZM8.5 4.5v5h6v-5M8 19.5v-6h8v6" />
  </Icon>
);

export const LibraryIcon = () => (
  <Icon>
    <rect x="4" y="4" width="7" height="7" rx="1.6" />
    <rect x="13" y="4" width="7" height="7" rx="1.6" />
    <rect x="4" y="13" width="7" height="7" rx="1.6" />
    <rect x="13" y="13" width="7" height="7" rx="1.6" />
  </Icon>
);

export const ShareIcon = () => (
  <Icon>
    <path d="M10 14a4.2 4.2 0 0 0 6 0l3-3a4.24 4.24 0 0 0-6-6l-1 1" />
    <path d="M14 10a4.2 4.2 0 0 0-6 0l-3 3a4.24 4.24 0 0 0 6 6l1-1" />
  </Icon>
);

export const DownloadIcon = () => (
  <Icon>
    <path d="M12 4v10.5M7.8 10.5l4.2 4.2 4.2-4.2" />
    <path d="M4.5 15.5v2.7a1.8 1.8 0 0 0 1.8 1.8h11.4a1.8 1.8 0 0 0 1.8-1.8v-2.7" />
  </Icon>
);

export const HelpIcon = () => (
  <Icon>
    <circle cx="12" cy="12" r="8.5" />
    <path d="M9.6 9.5a2.45 2.45 0 1 1 3.7 2.1c-.9.5-1.3 1-1.3 1.9" />
    <path d="M12 16.6v.01" />
  </Icon>
);

export const CloseIcon = () => (
  <Icon>
    <path d="m6.5 6.5 11 11M17.5 6.5l-11 11" />
  </Icon>
);

export const RenameIcon = () => (
  <Icon>
    <path d="m5 19 .8-3.6L15.6 5.6a1.9 1.9 0 0 1 2.8 2.8L8.6 18.2 5 19Z" />
  </Icon>
);

export const DeleteIcon = () => (
  <Icon>
    <path d="M5 7h14M9.5 7V5.2A1.2 1.2 0 0 1 10.7 4h2.6a1.2 1.2 0 0 1 1.2 1.2V7M7 7l.8 11.6a1.5 1.5 0 0 0 1.5 1.4h5.4a1.5 1.5 0 0 0 1.5-1.4L17 7" />
  </Icon>
);

export const PeopleIcon = () => (
  <Icon>
    <circle cx="9" cy="8.5" r="3.2" />
    <path d="M3.5 19c.4-3.4 2.5-5.2 5.5-5.2s5.1 1.8 5.5 5.2M15.5 5.6a3.2 3.2 0 0 1 0 5.8M17.2 14.3c1.9.7 3 2.3 3.3 4.7" />
  </Icon>
);

/** A loop of rope with its end hanging. */
export const LassoIcon = () => (
  <Icon>
    <path
      d="M12.5 3.5c4.7 0 8.2 2.2 8.2 5.300s-3.5 5.3-8.2 5.3-8.2-2.2-8.2-5.3 3.5-5.3 8.2-5.300Z"
      stroke-dasharray="3.6 2.9"
    />
    <path d="M6.8 13.100a2.3 2.3 0 1 0 2.2 2.400c.1 2.4-1 4.2-3.4 5.2" />
  </Icon>
);

/** A seed half in the ground, with a first root. */
export const SeedIcon = () => (
  <Icon>
    <path d="M12 3.500c2.6 2 3.7 4 3.7 5.800a3.7 3.7 0 0 1-7.4 0c0-1.8 1.1-3.8 3.7-5.800Z" />
    <path d="M3.5 14.500h3.300c.7 3.6 2.6 5.3 5.2 5.300s4.5-1.7 5.2-5.300h3.3" />
  </Icon>
);

export const StopIcon = () => (
  <Icon>
    <rect x="6.5" y="6.5" width="11" height="11" rx="2" fill="currentColor" />
  </Icon>
);

/** Two sliders. */
export const GrowthIcon = () => (
  <Icon>
    <path d="M4 7h7.500M16.5 7H20M4 17h2.500M11.5 17H20" />
    <circle cx="14" cy="7" r="2.5" />
    <circle cx="9" cy="17" r="2.5" />
  </Icon>
);

/** A box and a ball on the ground. */
export const SceneIcon = () => (
  <Icon>
    <path d="M3 20h18" />
    <path d="M4.5 20V6.500h7.500V20" />
    <circle cx="16.7" cy="16.2" r="3.8" />
  </Icon>
);

export const BoxIcon = () => (
  <Icon>
    <path d="m12 4 7 3.7v8.6L12 20l-7-3.7V7.7L12 4Z" />
    <path d="m5.3 7.9 6.7 3.6 6.7-3.6M12 11.5V20" />
  </Icon>
);

export const SphereIcon = () => (
  <Icon>
    <circle cx="12" cy="12" r="8" />
    <path d="M4.3 13.5c2 1.5 4.7 2.2 7.7 2.2s5.7-.7 7.7-2.2" />
  </Icon>
);

export const WallIcon = () => (
  <Icon>
    <rect x="3.5" y="5.5" width="17" height="13" rx="1" />
    <path d="M3.5 9.8h17M3.5 14.2h17M9 5.5v4.3M15 5.5v4.3M6.5 9.8v4.4M12 9.8v4.4M17.5 9.8v4.4M9 14.2v4.3M15 14.2v4.3" />
  </Icon>
);

export const PlaneIcon = () => (
  <Icon>
    <path d="M7 8.5h13.5L17 16H3.5L7 8.5Z" />
    <path d="M3.5 16v2.5H17L20.5 11V8.5" />
  </Icon>
);

export const ModelIcon = () => (
  <Icon>
    <path d="M5 20h14M7.5 20c-.3-3 .2-5 1.5-6.5C7.3 12.2 6.8 9 8.5 6.5 9.8 4.6 11 4 12 4s2.2.6 3.5 2.5c1.7 2.5 1.2 5.7-.5 7 1.3 1.5 1.8 3.5 1.5 6.5" />
  </Icon>
);

/** A bare tree for trees saved without a picture. */
export const TreeIcon = () => (
  <Icon>
    <path d="M12 21V9M12 15l-4-3.5M12 12.5l4-3.5" />
    <path d="M12 3.5c4.5 0 7 2.7 7 6s-2 5.5-4 5.5M12 3.5c-4.5 0-7 2.7-7 6s2 5.5 4 5.5" />
  </Icon>
);

/** A tree of lines: how it is built. */
export const ArchitectureIcon = () => (
  <Icon>
    <path d="M12 21V10M12 17l-5.500-4.500V8M12 14.500l5-4V6.500M12 10l-2.500-3V3.500M12 10l2-2.500V3.500M6.500 12.500 3.500 11M17 10.500l3.500-.5" />
  </Icon>
);

/** A brush with its tip down. */
export const BrushIcon = () => (
  <Icon>
    <path d="M19.500 3.500 11 12.200l1.900 1.900 7.600-9.500a.8.8 0 0 0-1-1.100Z" />
    <path d="M10.300 12.900c-2.200-.1-3.600 1.300-3.900 3.400-.2 1.600-1 2.600-2.400 3.100 3.900 1.300 8.200-.3 8.200-4.500" />
  </Icon>
);

/** A speech bubble. */
export const CommentIcon = () => (
  <Icon>
    <path d="M5.500 4.500h13a2 2 0 0 1 2 2v8a2 2 0 0 1-2 2H11l-4.500 4v-4h-1a2 2 0 0 1-2-2v-8a2 2 0 0 1 2-2Z" />
    <path d="M8 9h8M8 12.500h5" />
  </Icon>
);

/** A shoot that repeats itself between brackets. */
export const GrammarIcon = () => (
  <Icon>
    <path d="M7.500 4.500H5v15h2.500M16.500 4.500H19v15h-2.500M12 17.500v-11M12 14.500l-2.500-2M12 11.500l2.500-2" />
  </Icon>
);

export const LeafIcon = () => (
  <Icon>
    <path d="M6.500 17.500c-3-7 2-13 13.500-13.500.5 11.500-6 16.500-13.500 13.500Z" />
    <path d="M4 20.500c2.500-4.500 6-8 10.500-10.500M9.300 13.800l-.4-3.600M12.200 11.600l3.600.2" />
  </Icon>
);

/** A limb with its bark and the stub of a branch. */
export const BarkIcon = () => (
  <Icon>
    <path d="M8 21c.6-6 .6-12 0-18M16 21c-.5-3-.7-5.500-.7-8L20 9.500M15.400 9.600 16 3" />
    <path d="M11 7.500v3.500M12.800 13.500V17M10.500 16.500V19" />
  </Icon>
);

/** Hills under the sun. */
export const BackgroundIcon = () => (
  <Icon>
    <path d="M2.500 18.500c3.500-6 6.500-6 9.500-1.500 2-3.500 5-4.500 9.500.5" />
    <circle cx="16.500" cy="7.500" r="3" />
    <path d="M2.500 21h19" />
  </Icon>
);

/** An eye crossed out. */
export const HideIcon = () => (
  <Icon>
    <path d="M10 6.200c.6-.1 1.300-.2 2-.2 4.500 0 7.800 3 9.500 6-.6 1-1.400 2.100-2.400 3M6.600 7.600C4.700 8.800 3.300 10.500 2.500 12c1.700 3 5 6 9.500 6 1.700 0 3.200-.4 4.500-1.100" />
    <path d="M9.900 9.900a3 3 0 0 0 4.200 4.200M4 4l16 16" />
  </Icon>
);

export const ShowIcon = () => (
  <Icon>
    <path d="M2.500 12c1.700-3 5-6 9.500-6s7.800 3 9.500 6c-1.700 3-5 6-9.500 6s-7.800-3-9.500-6Z" />
    <circle cx="12" cy="12" r="3" />
  </Icon>
);

export const MoreIcon = () => (
  <Icon>
    <path d="M5.500 12v.01M12 12v.01M18.500 12v.01" stroke-width="3" />
  </Icon>
);

/** A wheel with teeth. */
export const SettingsIcon = () => (
  <Icon>
    <circle cx="12" cy="12" r="3" />
    <path d="M12 3.500v2.300M12 18.200v2.300M20.500 12h-2.300M5.800 12H3.500M18 6l-1.600 1.600M7.600 16.400 6 18M18 18l-1.600-1.600M7.600 7.600 6 6" />
    <circle cx="12" cy="12" r="6.200" />
  </Icon>
);
