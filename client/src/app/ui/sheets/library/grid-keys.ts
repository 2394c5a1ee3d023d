/** Which of the buttons of a grid the arrow keys lead to from another; null if the key is none of them. */
export function neighbour(buttons: readonly HTMLElement[], from: number, key: string): HTMLElement | null {
  const top = (button: HTMLElement | undefined) => button?.getBoundingClientRect().top;
  const columns = buttons.filter((button) => top(button) === top(buttons[0])).length;
  const steps: Readonly<Record<string, number>> = {
    ArrowLeft: -1,
    ArrowRight: 1,
    ArrowUp: -columns,
    ArrowDown: columns,
  };
  const step = steps[key];
  return step === undefined ? null : (buttons[from + step] ?? buttons[from] ?? null);
}
