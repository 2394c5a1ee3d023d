import type { ComponentChildren } from "preact";

interface ToolOptionsProps {
  readonly label: string;
  readonly children: ComponentChildren;
}

/** The options of the chosen tool, in one line at the bottom. */
export function ToolOptions({ label, children }: ToolOptionsProps) {
  return (
    <section class="panel tool-options single-line" aria-label={label}>
      {children}
    </section>
  );
}
