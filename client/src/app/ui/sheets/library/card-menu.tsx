import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { MoreIcon } from "../../icons";
import { placeBeside } from "./menu-place";

export interface Deed {
  readonly label: string;
  readonly act: () => void;
}

interface CardMenuProps {
  readonly label: string;
  readonly deeds: readonly Deed[];
}

/** What can be done with one thing of a list, behind a button. */
export function CardMenu({ label, deeds }: CardMenuProps) {
  const [open, setOpen] = useState(false);
  const button = useRef<HTMLButtonElement>(null);
  const list = useRef<HTMLUListElement>(null);
  // A press beside the menu closes it, also one on the button, which must not open it again.
  const wasOpen = useRef(false);
  useLayoutEffect(() => {
    if (open && list.current && button.current) {
      list.current.showPopover();
      place(list.current, button.current);
      list.current.querySelector("button")?.focus();
    }
  }, [open]);
  return (
    <>
      <button
        type="button"
        class="tool"
        ref={button}
        aria-label={label}
        aria-haspopup="menu"
        aria-expanded={open}
        onPointerDown={() => {
          wasOpen.current = open;
        }}
        onClick={() => {
          setOpen(!wasOpen.current);
          wasOpen.current = false;
        }}
      >
        <MoreIcon />
      </button>
      {open && (
        <ul
          class="menu card-menu"
          ref={list}
          popover="auto"
          aria-label={label}
          onToggle={({ newState }) => newState === "closed" && setOpen(false)}
          onKeyDown={(event) => {
            if (event.key === "Escape") {
              // The sheet below stays.
              event.preventDefault();
              event.stopPropagation();
              setOpen(false);
              button.current?.focus();
            }
          }}
        >
          {deeds.map(({ label, act }) => (
            <li key={label}>
              <button
                type="button"
                onClick={() => {
                  setOpen(false);
                  act();
                }}
              >
                {label}
              </button>
            </li>
          ))}
        </ul>
      )}
    </>
  );
}

/** What one may do, and nothing of what one may not. */
export function only(may: boolean, ...deeds: readonly Deed[]): readonly Deed[] {
  return may ? deeds : [];
}

function place(list: HTMLElement, button: HTMLElement): void {
  const card = button.closest("li") ?? button;
  const { left, top } = placeBeside(
    list.getBoundingClientRect(),
    button.getBoundingClientRect(),
    card.getBoundingClientRect(),
    { width: innerWidth, height: innerHeight },
  );
  list.style.left = `${left}px`;
  list.style.top = `${top}px`;
}
