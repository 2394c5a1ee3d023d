/** Files on their way. */
export const TRANSFERS = {
  "transfers.export": ["Making the file…", "Die Datei entsteht…"],
  "transfers.export.waits": [
    "Waiting for files of others: {count} before yours",
    "Wartet auf Dateien anderer: {count} vor deiner",
  ],
  "transfers.export.making": ["Making the file, {percent} %", "Die Datei entsteht, {percent} %"],
  "transfers.export.moving": ["Loading the file, {megabytes} MB", "Die Datei wird geladen, {megabytes} MB"],
  "transfers.export.part": [
    "Loading the file, {done} of {megabytes} MB",
    "Die Datei wird geladen, {done} von {megabytes} MB",
  ],
  "transfers.export.read": ["The file is there", "Die Datei ist da"],
  "transfers.picture": ["Making the picture…", "Das Bild entsteht…"],
  "transfers.picture.part": ["Making the picture, {percent} %", "Das Bild entsteht, {percent} %"],
  "transfers.picture.read": ["Writing the picture…", "Das Bild wird geschrieben…"],
  "transfers.import": ["Sending the model…", "Das Modell wird gesendet…"],
  "transfers.import.moving": ["Sending the model, {megabytes} MB", "Das Modell wird gesendet, {megabytes} MB"],
  "transfers.import.part": [
    "Sending the model, {done} of {megabytes} MB",
    "Das Modell wird gesendet, {done} von {megabytes} MB",
  ],
  "transfers.import.read": ["The server reads the model…", "Der Server liest das Modell…"],
  "transfers.tree": ["Sending the file…", "Die Datei wird gesendet…"],
  "transfers.tree.moving": ["Sending the file, {megabytes} MB", "Die Datei wird gesendet, {megabytes} MB"],
  "transfers.tree.part": [
    "Sending the file, {done} of {megabytes} MB",
    "Die Datei wird gesendet, {done} von {megabytes} MB",
  ],
  "transfers.tree.read": ["The server makes a tree of it…", "Der Server macht daraus einen Baum…"],
  "transfers.cancel": ["Cancel", "Abbrechen"],
} as const;
