/** Giving a tree or a collection to people and groups. */
export const GIFTS = {
  "gifts.open": ["Share with people…", "Mit Menschen teilen…"],
  "gifts.back": ["Back to Share", "Zurück zu Teilen"],
  "gifts.back.people": ["Back to who is here", "Zurück zu denen, die hier sind"],
  "gifts.asking": ["Asking the server…", "Der Server wird gefragt…"],
  "gifts.advice.tree": [
    "Whoever is listed below finds this tree in their library when they log in, also where they may see nothing else.",
    "Wer unten steht, findet diesen Baum nach dem Anmelden in der Bibliothek, auch wer sonst nichts sehen darf.",
  ],
  "gifts.advice.collection": [
    "Whoever is listed below finds this collection in their library when they log in, with all trees in it and in the collections inside it, also those that are added later.",
    "Wer unten steht, findet diese Sammlung nach dem Anmelden in der Bibliothek, mit allen Bäumen darin und in den Sammlungen darin, auch mit späteren.",
  ],
  "gifts.within": [
    "It lies in “{collection}”: whoever was given that has this as well.",
    "Das liegt in „{collection}“: Wem sie gegeben ist, der hat auch dies.",
  ],
  "gifts.kind": ["With whom", "Mit wem"],
  "gifts.kind.user": ["A person", "Einer Person"],
  "gifts.kind.group": ["A group", "Einer Gruppe"],
  "gifts.name.user": ["Name they log in with", "Name, mit dem sie sich anmelden"],
  "gifts.name.group": ["Name of the group", "Name der Gruppe"],
  "gifts.names": ["Names to pick from", "Namen zur Auswahl"],
  "gifts.role.viewer": [
    "They see it, play how it came about, read comments and download files.",
    "Sie sehen es, spielen ab, wie es entstand, lesen Kommentare und laden Dateien herunter.",
  ],
  "gifts.role.commenter": ["They also write comments.", "Sie schreiben auch Kommentare."],
  "gifts.role.editor": ["They also draw, comment and save.", "Sie zeichnen auch, kommentieren und speichern."],
  "gifts.role.owner": [
    "They also draw, comment, save, lock, delete, and share it with others.",
    "Sie zeichnen auch, kommentieren, speichern, sperren, löschen und teilen es mit anderen.",
  ],
  "gifts.give": ["Share", "Teilen"],
  "gifts.nobody.user": [
    "Nobody called “{name}” can log in here. Write the name as they log in with it; ask them if you do not know.",
    "Niemand kann sich hier als „{name}“ anmelden. Schreib den Namen so, wie sie sich damit anmelden; frag sie, wenn du ihn nicht weißt.",
  ],
  "gifts.nobody.group": ["There is no group called “{name}” here.", "Eine Gruppe „{name}“ gibt es hier nicht."],
  "gifts.unnamed.user": ["Write the name of a person first.", "Schreib zuerst den Namen eines Menschen."],
  "gifts.unnamed.group": ["Write the name of a group first.", "Schreib zuerst den Namen einer Gruppe."],
  "gifts.head": ["Shared with", "Geteilt mit"],
  "gifts.none": [
    "With nobody by name yet. Whoever may see the whole library sees it anyhow.",
    "Noch mit niemandem namentlich. Wer die ganze Bibliothek sehen darf, sieht es ohnehin.",
  ],
  "gifts.group": ["Group", "Gruppe"],
  "gifts.take-back": ["Take back", "Zurücknehmen"],
  "gifts.take-back.which": ["Take it back from {name}", "Von {name} zurücknehmen"],
  "gifts.taken": ["It is no longer shared with {name}", "Es ist nicht mehr mit {name} geteilt"],
  "gifts.undo": ["Undo", "Rückgängig"],
  "gifts.closed": [
    "There is nobody to share it with by name: no one has a name and a password on this server.",
    "Es gibt niemanden, mit dem du es namentlich teilen könntest: Auf diesem Server hat niemand Name und Passwort.",
  ],
  "gifts.closed.admin": [
    "Add people first, and have the server started with --auth: it asks everybody for name and password then.",
    "Füge zuerst Menschen hinzu und lass den Server mit --auth starten: Dann fragt er alle nach Name und Passwort.",
  ],
  "gifts.closed.other": [
    "An administrator can add people (Settings, People, groups and programs) and start the server with --auth.",
    "Wer den Server verwaltet, kann Menschen hinzufügen (Einstellungen, Menschen, Gruppen und Programme) und ihn mit --auth starten.",
  ],
  "gifts.closed.people": ["Add people…", "Menschen hinzufügen…"],
  "gifts.closed.link": ["Share by a link instead…", "Stattdessen per Link teilen…"],
  "gifts.closed.collection": [
    "Without that, single trees are shared by a link, from the menu of each.",
    "Ohne das lassen sich einzelne Bäume per Link teilen, aus dem Menü eines jeden.",
  ],
} as const;
