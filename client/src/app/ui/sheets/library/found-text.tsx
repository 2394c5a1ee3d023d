import { pieces } from "../../../library/found-text";

/** A text in which the words that were searched are marked. */
export function FoundText({ text, words }: { readonly text: string; readonly words: string }) {
  return <>{pieces(text, words).map(({ text, found }) => (found ? <mark>{text}</mark> : text))}</>;
}
