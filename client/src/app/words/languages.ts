/** Languages the interface speaks, in the order in which each text stands. */
export const LANGUAGES = ["en", "de"] as const;
export type Language = (typeof LANGUAGES)[number];
