import type { CheckGrammar, GrammarOrigins, GrammarReport, ShippedGrammar } from "../../../wire/generated";
import { ask } from "../../requests/request";

/** The grammars that come with the program. */
export function shippedGrammars(): Promise<readonly ShippedGrammar[]> {
  return ask("GET", "/api/v1/grammars");
}

/** What there is to say of a text; its sizes where they are wanted. */
export function checkGrammar(check: CheckGrammar): Promise<GrammarReport> {
  return ask("POST", "/api/v1/grammars/check", check);
}

/** Which rule made each row of the grammar in force. */
export function originsIn(session: string): Promise<GrammarOrigins> {
  return ask("GET", `/api/v1/sessions/${encodeURIComponent(session)}/grammar`);
}
