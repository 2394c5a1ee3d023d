import { signal } from "@preact/signals";
import type { ComponentChildren } from "preact";

/** Which sections are open, by their names: a panel opens as it was closed. */
const unfolded = signal<ReadonlyMap<string, boolean>>(new Map());

/** Opens a section, wherever it stands. */
export function unfold(name: string): void {
  unfolded.value = new Map(unfolded.peek()).set(name, true);
}

interface SectionProps {
  /** What it is remembered by. */
  readonly name: string;
  readonly title: string;
  /** Whether it is open before anyone has folded or unfolded it. */
  readonly open?: boolean;
  readonly children: ComponentChildren;
}

/** Controls that belong together, folded away under a title. */
export function Section({ name, title, open = false, children }: SectionProps) {
  const isOpen = unfolded.value.get(name) ?? open;
  return (
    <details
      class="section"
      open={isOpen}
      onToggle={(event) => {
        const now = event.currentTarget.open;
        if (now !== isOpen) {
          unfolded.value = new Map(unfolded.peek()).set(name, now);
        }
      }}
    >
      <summary>{title}</summary>
      {isOpen && <div class="section-body">{children}</div>}
    </details>
  );
}
