import type { Text } from "./say";

/** Why the picture is coarse: texts that come with the line itself, before those of all other parts. */
export const SLOWNESS = {
  cardless: [
    "Without a graphics card the picture is coarse while it moves, and of a large tree also at rest; the settings can change that. If this device has one, turn on hardware acceleration in the browser's settings.",
    "Ohne Grafikkarte ist das Bild grob, solange es sich bewegt, bei großen Bäumen auch in Ruhe; das lässt sich in den Einstellungen ändern. Hat dieses Gerät eine, dann schalte in den Einstellungen des Browsers die Hardwarebeschleunigung ein.",
  ],
  tree: [
    "This tree is large for this device: the picture is coarse while it moves.",
    "Dieser Baum ist groß für dieses Gerät: Das Bild ist grob, solange es sich bewegt.",
  ],
  close: ["Got it", "Verstanden"],
} as const satisfies Record<string, Text>;
