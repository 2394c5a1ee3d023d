import { Part } from "../part";
import type { StudioView } from "../part-view";

/** The depth of a grammar beside the line of time, once one is planted. */
export const DEPTH = new Part<StudioView>(async () => (await import("./depth-stepper")).DepthStepper);
