import { useEffect } from "preact/hooks";
import { ownJobs } from "../../../library/variations/own-jobs";
import { sentence } from "../../../problems/plain-words";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { BackBar } from "../library/back-bar";
import { JobCard } from "./job-card";
import { OrderForm } from "./order-form";

/** Orders many trees like one, and shows what was ordered: how far it is, and its files. */
export function VariationsSheet({ studio }: { studio: Studio }) {
  const { pattern: chosen } = studio.layout;
  const pattern = chosen.value;
  const jobs = ownJobs();
  useEffect(() => {
    const stop = jobs.follow();
    // What was there a while ago may be gone.
    void jobs.look();
    return () => {
      stop();
      chosen.value = null;
    };
  }, [jobs, chosen]);
  const [list, failure] = [jobs.list.value, jobs.failure.value];
  return (
    <div class="stack">
      <BackBar studio={studio} title={pattern === null ? "" : say("variations.which", { name: pattern.name })} />
      {pattern === null ? (
        <p class="quiet">{say("variations.how")}</p>
      ) : (
        <OrderForm key={pattern.template} jobs={jobs} pattern={pattern} />
      )}
      <section class="stack" aria-label={say("variations.jobs")}>
        <h3 class="sheet-head">{say("variations.jobs")}</h3>
        {failure !== null && (
          <div class="actions">
            <p role="alert">{sentence(failure)}</p>
            <button type="button" class="small" onClick={() => void jobs.look()}>
              {say("sheets.library.again")}
            </button>
          </div>
        )}
        {list === null && failure === null && <p class="quiet">{say("notices.looking")}</p>}
        {list?.length === 0 && <p class="quiet">{say("variations.none")}</p>}
        {list !== null && list.length > 0 && <p class="quiet">{say("variations.kept")}</p>}
        {list?.map((job) => (
          <JobCard key={job.id} studio={studio} jobs={jobs} job={job} />
        ))}
      </section>
    </div>
  );
}
