/** Files on their way. */
export const TRANSFERS = {
  "transfers.export": ["Making the glTF file…", "Die glTF-Datei entsteht…"],
  "transfers.export.moving": ["Loading the glTF file, {megabytes} MB", "Die glTF-Datei wird geladen, {megabytes} MB"],
  "transfers.export.part": [
    "Loading the glTF file, {done} of {megabytes} MB",
    "Die glTF-Datei wird geladen, {done} von {megabytes} MB",
  ],
  "transfers.export.read": ["The glTF file is there", "Die glTF-Datei ist da"],
  "transfers.import": ["Sending the model…", "Das Modell wird gesendet…"],
  "transfers.import.moving": ["Sending the model, {megabytes} MB", "Das Modell wird gesendet, {megabytes} MB"],
  "transfers.import.part": [
    "Sending the model, {done} of {megabytes} MB",
    "Das Modell wird gesendet, {done} von {megabytes} MB",
  ],
  "transfers.import.read": ["The server reads the model…", "Der Server liest das Modell…"],
  "transfers.cancel": ["Cancel", "Abbrechen"],
} as const;
