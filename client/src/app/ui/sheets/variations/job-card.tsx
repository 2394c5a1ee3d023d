import { useState } from "preact/hooks";
import { archiveOf, type GrownTree, type Job, type JobNote } from "../../../library/variations/job-api";
import { isActive, type Jobs } from "../../../library/variations/jobs";
import { plainly, sentence } from "../../../problems/plain-words";
import type { Studio } from "../../../studio";
import { numberText } from "../../../words/number-text";
import { language, say } from "../../../words/say";
import { ConfirmRow } from "../confirm-row";

/** So many files are shown at first. */
const SHOWN = 24;

interface JobCardProps {
  readonly studio: Studio;
  readonly jobs: Jobs;
  readonly job: Job;
}

/** Trees that were ordered: how far they are, their files, and a way to give them up, which is asked about once. */
export function JobCard({ studio, jobs, job }: JobCardProps) {
  const [asks, setAsks] = useState(false);
  const { id, all, done, results, failed, problem } = job;
  const order = jobs.orderOf(id);
  const name = order?.name ?? id;
  const text = stateText(job);
  const active = isActive(job);
  const end = async () => {
    try {
      await jobs.giveUp(id);
    } catch (error) {
      studio.toasts.show(sentence(error));
    }
  };
  return (
    <article class="job" id={`job-${id}`} data-state={job.state}>
      <div class="job-head">
        <div>
          <strong>{say(order ? "variations.of" : "variations.of-elsewhere", { count: all, name })}</strong>{" "}
          {order && <span class="quiet">.{order.ending}</span>}
          <br />
          <span class="quiet" role="status">
            {text}
          </span>
        </div>
        {!asks && (
          <button
            type="button"
            class="small"
            aria-label={say(active ? "variations.cancel.which" : "variations.remove.which", { name })}
            // Nothing is lost with one that has no files.
            onClick={() => (results.length === 0 ? void end() : setAsks(true))}
          >
            {say(active ? "variations.cancel" : "variations.remove")}
          </button>
        )}
      </div>
      {asks && (
        <ConfirmRow
          question={say("variations.sure")}
          act={say(active ? "variations.cancel" : "variations.remove")}
          onAct={end}
          onKeep={() => setAsks(false)}
        />
      )}
      {active && <progress max={all} value={done} aria-label={text} />}
      {problem && <p class="warning">{plainly(problem)}</p>}
      {job.notes?.map((note) => (
        <p class="quiet" key={note.note}>
          {noteText(note)}
        </p>
      ))}
      <Files results={results} />
      {results.length > 1 && (
        <a class="job-archive" href={archiveOf(id)} download>
          {say("variations.all", { count: results.length })}
        </a>
      )}
      {failed.map(({ seed, problem }) => (
        <p class="quiet" key={seed}>
          {say("variations.failed", { seed, reason: plainly(problem) })}
        </p>
      ))}
    </article>
  );
}

/** The files so far; of many, the first ones until more are asked for. */
function Files({ results }: { readonly results: readonly GrownTree[] }) {
  const [open, setOpen] = useState(false);
  if (results.length === 0) {
    return null;
  }
  const shown = open ? results : results.slice(0, SHOWN);
  return (
    <>
      <ul class="job-files">
        {shown.map(({ seed, metamers, bytes, address }) => (
          <li key={seed}>
            <a href={address} download aria-label={say("variations.file.which", { seed })}>
              <strong>{say("variations.file", { seed })}</strong>
              <span class="quiet">
                {say("variations.file.facts", {
                  metamers: metamers.toLocaleString(language.value),
                  megabytes: numberText(Math.max(0.1, bytes / 1e6), 0.1),
                })}
              </span>
            </a>
          </li>
        ))}
      </ul>
      {shown.length < results.length && (
        <button type="button" class="small library-more" onClick={() => setOpen(true)}>
          {say("variations.more", { count: results.length })}
        </button>
      )}
    </>
  );
}

/** What trees are without, in words. */
function noteText({ note, operations = [] }: JobNote): string {
  const what = operations.map(({ kind, count }) => {
    const name = say(`operations.kind.${kind}`);
    return count === 1 ? name : `${count} × ${name}`;
  });
  return say(`variations.${note}`, { what: what.join(", ") });
}

/** How far a job is, in words. */
function stateText({ state, ahead, done, all, growing, results }: Job): string {
  switch (state) {
    case "waiting":
      return say(ahead === 0 ? "variations.waiting.next" : "variations.waiting", { ahead });
    case "growing":
      return say(growing ? "variations.growing.seed" : "variations.growing", {
        done,
        all,
        seed: growing?.seed ?? 0,
        metamers: (growing?.metamers ?? 0).toLocaleString(language.value),
      });
    case "done":
    case "failed":
      return say(results.length === all ? "variations.done" : "variations.done.some", { done: results.length, all });
  }
}
