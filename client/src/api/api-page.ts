import SwaggerUI from "swagger-ui-dist/swagger-ui-es-bundle.js";
import "swagger-ui-dist/swagger-ui.css";
import "./api-page.css";
import { listOfReasons } from "./reasons";

/** Where the server describes itself. */
const DESCRIPTION = "/api/v1/openapi.json";

const dark = matchMedia("(prefers-color-scheme: dark)");
const follow = () => document.documentElement.classList.toggle("dark-mode", dark.matches);
dark.addEventListener("change", follow);
follow();

SwaggerUI({
  dom_id: "#api",
  url: DESCRIPTION,
  deepLinking: true,
  filter: true,
  // Addresses by what they are about: more than 126 at once are not all drawn.
  docExpansion: "none",
  defaultModelsExpandDepth: 0,
  tryItOutEnabled: true,
  displayRequestDuration: true,
  // Nothing is asked of any other server.
  validatorUrl: null,
});

// Where the `type` of a problem leads (`ER1`).
const answer = await fetch(DESCRIPTION);
if (answer.ok) {
  document.body.append(listOfReasons(await answer.json()));
  const at = location.hash.slice(1);
  document.getElementById(at)?.scrollIntoView();
}
