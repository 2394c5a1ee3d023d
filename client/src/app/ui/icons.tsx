import type { ComponentChildren } from "preact";

function Icon({ children }: { children: ComponentChildren }) {
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
    <path d="M12 4v10.5M7.8 10.5l4.2 4.2 4.2-4.2" />
    <path d="M4.5 15.5v2.7a1.8 1.8 0 0 0 1.8 1.8h11.4a1.8 1.8 0 0 0 1.8-1.8v-2.7" />
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
    <path d="m12 3.5 7.4 4.2v8.6L12 20.5l-7.4-4.2V7.7L12 3.5Z" />
    <path d="m4.8 7.9 7.2 4.1 7.2-4.1M12 12v8.3" />
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

/** A bare tree for trees saved without a picture. */
export const TreeIcon = () => (
  <Icon>
    <path d="M12 21V9M12 15l-4-3.5M12 12.5l4-3.5" />
    <path d="M12 3.5c4.5 0 7 2.7 7 6s-2 5.5-4 5.5M12 3.5c-4.5 0-7 2.7-7 6s2 5.5 4 5.5" />
  </Icon>
);
