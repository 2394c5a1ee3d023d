/** Saving, the library, and sharing. */
export const SHEETS = {
  "sheets.save.default": ["Tree {date}", "Baum {date}"],
  "sheets.save.name": ["Name", "Name"],
  "sheets.save.advice": [
    "The tree goes into the library as it stands now. Drawing on does not change what is saved.",
    "Der Baum kommt in die Bibliothek, wie er jetzt ist. Weiterzeichnen ändert nicht, was gespeichert ist.",
  ],
  "sheets.save.act": ["Save tree", "Baum speichern"],
  "sheets.save.saving": ["Saving…", "Speichert…"],
  "sheets.save.done": ["Saved “{name}”", "„{name}“ gespeichert"],
  "sheets.leave.text": [
    "This tree is not saved as it stands. Where should it stay while you begin a new one?",
    "Dieser Baum ist nicht gespeichert, wie er jetzt ist. Wo soll er bleiben, während du einen neuen beginnst?",
  ],
  "sheets.leave.save": ["Save it", "Speichern"],
  "sheets.leave.keep": ["Keep under Unsaved", "Unter Ungespeichert behalten"],
  "sheets.leave.drop": ["Do not keep it", "Nicht behalten"],
  "sheets.unsaved": ["Unsaved", "Ungespeichert"],
  "sheets.unsaved.advice": [
    "Trees you left on this device without saving them. Each goes on where you left it.",
    "Bäume, die du auf diesem Gerät verlassen hast, ohne sie zu speichern. Jeder geht weiter, wo du aufgehört hast.",
  ],
  "sheets.unsaved.open": ["Go on with the tree of {date}", "Mit dem Baum vom {date} weitermachen"],
  "sheets.unsaved.forget": ["Forget", "Vergessen"],
  "sheets.unsaved.forget.which": ["Forget the tree of {date}", "Den Baum vom {date} vergessen"],
  "sheets.unsaved.forget.sure": ["Only its link leads to it then.", "Dann führt nur noch sein Link zu ihm."],
  "sheets.saved": ["Saved", "Gespeichert"],
  "sheets.recent": ["Go on with a tree", "Mit einem Baum weitermachen"],
  "sheets.recent.hide": ["Hide these trees", "Diese Bäume ausblenden"],
  "sheets.library.empty": [
    "Nothing saved yet. Trees you save appear here.",
    "Noch nichts gespeichert. Gespeicherte Bäume erscheinen hier.",
  ],
  "sheets.library.more": ["Show more", "Mehr zeigen"],
  "sheets.library.again": ["Try again", "Noch einmal versuchen"],
  "sheets.library.open": ["Open {name}", "{name} öffnen"],
  "sheets.library.new-name": ["New name", "Neuer Name"],
  "sheets.library.rename": ["Rename", "Umbenennen"],
  "sheets.library.rename.which": ["Rename {name}", "{name} umbenennen"],
  "sheets.library.delete": ["Delete", "Löschen"],
  "sheets.library.delete.which": ["Delete {name}", "{name} löschen"],
  "sheets.library.delete.sure": ["Delete for good?", "Endgültig löschen?"],
  "sheets.library.keep": ["Keep", "Behalten"],
  "sheets.share.advice": [
    "Whoever opens this link sees the same tree grow, and may draw on it.",
    "Wer diesen Link öffnet, sieht denselben Baum wachsen und kann mitzeichnen.",
  ],
  "sheets.share.link": ["Link to this tree", "Link zu diesem Baum"],
  "sheets.share.copy": ["Copy link", "Link kopieren"],
  "sheets.share.copied": ["Link copied", "Link kopiert"],
  "sheets.share.marked": ["Copy the marked link", "Kopiere den markierten Link"],
  "sheets.share.only-here": [
    "This link works on this machine only. For a tablet, open the network address the server printed when it started, and share from there.",
    "Dieser Link gilt nur auf diesem Rechner. Öffne für ein Tablet die Netzadresse, die der Server beim Start gezeigt hat, und teile von dort.",
  ],
} as const;

/** Titles of the sheets. */
export const SHEET_TITLES = {
  "sheets.save": ["Save this tree", "Diesen Baum speichern"],
  "sheets.leave": ["A new tree", "Ein neuer Baum"],
  "sheets.library": ["Library", "Bibliothek"],
  "sheets.share": ["Draw together", "Zusammen zeichnen"],
  "sheets.help": ["How to draw a tree", "So zeichnet man einen Baum"],
  "sheets.settings": ["Settings", "Einstellungen"],
} as const;
