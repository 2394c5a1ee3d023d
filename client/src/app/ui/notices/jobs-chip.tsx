import { useEffect } from "preact/hooks";
import type { Job } from "../../library/variations/job-api";
import { ownJobs } from "../../library/variations/own-jobs";
import type { Studio } from "../../studio";
import { say } from "../../words/say";

/** How far ordered trees are, also those of before a reload, and a note when they are done. */
export function JobsChip({ studio }: { studio: Studio }) {
  const jobs = ownJobs();
  const { sheet, pattern } = studio.layout;
  const any = jobs.ordered.value.length > 0;
  useEffect(() => {
    const show = () => {
      pattern.value = null;
      sheet.value = "variations";
    };
    const ended = (job: Job) => {
      // Where the files stand, nobody need be told that they are there.
      if (sheet.peek() !== "variations") {
        const name = jobs.orderOf(job.id)?.name;
        const text = say(name === undefined ? "variations.ended.elsewhere" : "variations.ended", {
          count: job.results.length,
          name: name ?? "",
        });
        studio.toasts.show(text, { label: say("variations.show"), act: show });
      }
    };
    return any ? jobs.follow(ended) : undefined;
  }, [studio, jobs, any, sheet, pattern]);
  const active = jobs.active.value;
  if (active.length === 0) {
    return null;
  }
  const sum = (part: (job: Job) => number) => active.reduce((sum, job) => sum + part(job), 0);
  const [done, all] = [sum((job) => job.done), sum((job) => job.all)];
  const name = active.length === 1 ? jobs.orderOf(active[0]!.id)?.name : undefined;
  const text = say(name === undefined ? "variations.chip.some" : "variations.chip", { done, all, name: name ?? "" });
  return (
    <p class="chip">
      <progress max={all} value={done} aria-label={text} />
      {text}
      <button
        type="button"
        class="chip-stop"
        onClick={() => {
          pattern.value = null;
          sheet.value = "variations";
        }}
      >
        {say("variations.show")}
      </button>
    </p>
  );
}
