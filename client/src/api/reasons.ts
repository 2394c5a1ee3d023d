/** What of the description is read here. */
interface Description {
  readonly components: {
    readonly schemas: {
      readonly Reason: { readonly oneOf: readonly { readonly const: string; readonly description: string }[] };
    };
  };
}

function element(name: string, text: string, id?: string): HTMLElement {
  const made = document.createElement(name);
  made.textContent = text;
  if (id !== undefined) {
    made.id = id;
  }
  return made;
}

/** Every reason why something may be refused, each with its sentence and a place that an address can lead to. */
export function listOfReasons(description: Description): HTMLElement {
  const list = document.createElement("dl");
  for (const reason of description.components.schemas.Reason.oneOf) {
    list.append(element("dt", reason.const, reason.const), element("dd", reason.description));
  }
  const section = document.createElement("section");
  section.className = "reasons";
  section.append(element("h2", "Why something is refused"), list);
  return section;
}
