import type { Signal } from "@preact/signals";

interface CheckProps {
  readonly label: string;
  readonly chosen: Signal<boolean>;
}

/** What is so or not. */
export function Check({ label, chosen }: CheckProps) {
  return (
    <label class="switch">
      <input
        type="checkbox"
        checked={chosen.value}
        onChange={(event) => {
          chosen.value = event.currentTarget.checked;
        }}
      />
      <span>{label}</span>
    </label>
  );
}
