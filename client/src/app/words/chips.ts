/** What is in progress and can be ended, but for files on their way. */
export const CHIPS = {
  "tools.placing.copy": [
    "Tap the limb for the copy, drag to aim it",
    "Ast für die Kopie antippen, ziehen zum Ausrichten",
  ],
  "tools.placing.move": ["Tap the limb to move it to, drag to aim it", "Neuen Ast antippen, ziehen zum Ausrichten"],
  "tools.placing.cancel": ["Leave the branch where it is", "Den Ast lassen, wo er ist"],
  "tools.placing.cancel.title": ["Leave the branch where it is (Esc)", "Den Ast lassen, wo er ist (Esc)"],
  "tools.bud": ["Only this branch grows", "Nur dieser Ast wächst"],
  "tools.bud.release": ["Let every branch grow", "Alle Äste wachsen lassen"],
  "tools.bud.release.title": ["Let every branch grow (Esc)", "Alle Äste wachsen lassen (Esc)"],
  "chips.symmetry.end": ["End the symmetry", "Symmetrie beenden"],
  "tools.widened": ["Moved back to show the growth", "Zurückgegangen, um das Wachstum zu zeigen"],
  "tools.widened.back": ["Back to my view", "Zurück zu meiner Ansicht"],
  "tools.growing": ["Growing…", "Wächst…"],
  "tools.growing.steps": ["Growing… {count} steps to go", "Wächst… noch {count} Schritte"],
  "tools.fitting": ["Describing the tree…", "Beschreibt den Baum…"],
  "tools.fitting.trials": [
    "Describing the tree… up to {count} tries to go",
    "Beschreibt den Baum… noch bis zu {count} Versuche",
  ],
  "tools.fitting.stop.title": [
    "Stop, and leave the tree as it is (Esc)",
    "Aufhören und den Baum lassen, wie er ist (Esc)",
  ],
  "chips.paused.fitting": [
    "The description of the tree waits for memory on the server, then goes on",
    "Die Beschreibung des Baums wartet auf Speicher im Server und geht dann weiter",
  ],
  "tools.growing.outline": ["Growing into the outline…", "Wächst in den Umriss…"],
  "chips.paused.memory": [
    "Growth waits for memory on the server, then goes on",
    "Das Wachstum wartet auf Speicher im Server und geht dann weiter",
  ],
  "chips.paused.crashes": [
    "The server failed twice while growing this. What was drawn is kept and waits",
    "Der Server ist hieran zweimal gescheitert. Was gezeichnet wurde, ist behalten und wartet",
  ],
  "chips.paused.owner": ["; an owner can let it go on", "; ein Eigentümer kann es weitergehen lassen"],
  "tools.growing.stop": ["Stop", "Anhalten"],
  "tools.growing.stop.title": ["Stop growing (Esc)", "Wachstum anhalten (Esc)"],
} as const;
