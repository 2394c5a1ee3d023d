import { LOOKS } from "../../wire/generated-tables";

/** What can be set of the wind, row by row; apart, for the first picture does without. */
export const AIR_NUMBERS = LOOKS.wind;
