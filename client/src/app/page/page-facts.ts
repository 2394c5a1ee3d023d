import type { Studio } from "../studio";

/** What automated tests and assistive scripts can read of the page, on its root element. */
export function publishFacts(studio: Studio): void {
  const { dataset } = document.documentElement;
  const state = studio.document.value;
  const timeline = studio.time.timeline.value;
  const facts = {
    connection: studio.link.phase.value,
    sent: studio.link.sent.value,
    acknowledged: studio.link.settled.value,
    rows: studio.rows.value,
    metamers: state?.metamers ?? 0,
    step: state?.step ?? 0,
    pending: state?.pending_steps ?? 0,
    tool: studio.tools.chosen.value,
    bud: studio.bud.row.value ?? "",
    obstacles: studio.obstacles.list.value.length,
    present: timeline?.step ?? 0,
    lastStep: timeline?.last_step ?? 0,
    operations: timeline?.operations.map(({ kind }) => kind).join(" ") ?? "",
    done: timeline?.done ?? 0,
    futures: timeline?.futures.length ?? 0,
    branch: studio.branches.held.row.value ?? "",
    ghost: studio.branches.prediction.grown.value ?? "",
  };
  for (const [name, value] of Object.entries(facts)) {
    dataset[name] = String(value);
  }
}
