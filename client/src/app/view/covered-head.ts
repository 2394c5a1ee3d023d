/** More of the picture than this nothing covers: what is shown of the tree would be too small. */
const MOST = 0.3;

/** The share of the picture that the tool bar covers at its upper edge. */
export function coveredHead(): number {
  const bar = document.querySelector<HTMLElement>(".tool-bar");
  const height = bar?.offsetParent?.clientHeight ?? 0;
  return bar && height > 0 ? Math.min((bar.offsetTop + bar.offsetHeight) / height, MOST) : 0;
}
