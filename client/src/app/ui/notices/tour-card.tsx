import { TOUR_STEPS } from "../../help/tour";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { Check } from "../controls/check";
import { GestureSketch } from "../sheets/gesture-sketch";
import { useAnimationFrames } from "../use-animation-frames";

/** The gesture the tour is at: what to do, and what it looks like; the workspace stays in use. */
export function TourCard({ studio }: { studio: Studio }) {
  const { tour } = studio;
  const step = tour.step.value;
  useAnimationFrames(step === "turn", () => tour.look());
  if (step === null) {
    return null;
  }
  const number = TOUR_STEPS.indexOf(step) + 1;
  const last = number === TOUR_STEPS.length;
  return (
    <section class="panel tour" aria-label={say("help.tour.label")} data-done={tour.done.value}>
      <GestureSketch name={step} />
      <div class="tour-words" aria-live="polite">
        <h2>
          {say(`help.tour.${step}`)}
          <span class="tour-count">{say("help.tour.step", { step: number, count: TOUR_STEPS.length })}</span>
        </h2>
        <p>{say(`help.tour.${step}.text`)}</p>
      </div>
      <Check label={say("settings.names")} chosen={studio.settings.namesShown} />
      <div class="tour-ways">
        {!last && (
          <button type="button" class="small" onClick={() => tour.skip()}>
            {say("help.tour.skip")}
          </button>
        )}
        <button type="button" class="primary" onClick={() => tour.next()}>
          {say(last ? "help.tour.done" : "help.tour.next")}
        </button>
      </div>
    </section>
  );
}
