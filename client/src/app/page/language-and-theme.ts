import { effect } from "@preact/signals";
import { speak } from "../words/later-words";
import { language, preferredLanguage } from "../words/say";
import type { Settings } from "./settings";

/** Colours of the browser's own bars, beside the page. */
const BAR_COLOURS = { light: "#dfe9ee", dark: "#171c19" } as const;

/**
 * Sets the language and the theme of the page: those chosen, else those of the browser and the system. Calls `failed`
 * where the texts of a language cannot be loaded; the page then goes on in the one it has.
 */
export function followChoices(settings: Settings, failed: () => void): () => void {
  const root = document.documentElement;
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const paintBars = () => {
    const theme = settings.theme.peek() ?? (dark.matches ? "dark" : "light");
    document.querySelector('meta[name="theme-color"]')?.setAttribute("content", BAR_COLOURS[theme]);
  };
  /** The last choice whose language could be spoken. */
  let spoken = settings.language.peek();
  const stopChoosing = effect(() => {
    const chosen = settings.language.value;
    speak(chosen ?? preferredLanguage(navigator.languages)).then(
      () => {
        spoken = chosen;
      },
      () => {
        failed();
        // The choice shown is that of the page, and the same one can be made again.
        if (settings.language.peek() === chosen) {
          settings.language.value = spoken;
        }
      },
    );
  });
  const stopLanguage = effect(() => {
    root.lang = language.value;
  });
  const stopTheme = effect(() => {
    root.dataset.theme = settings.theme.value ?? "system";
    paintBars();
  });
  dark.addEventListener("change", paintBars);
  return () => {
    stopChoosing();
    stopLanguage();
    stopTheme();
    dark.removeEventListener("change", paintBars);
  };
}
