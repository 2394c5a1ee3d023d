/** The sun that can be dragged around the tree. */
export const SUN = {
  "sun.label": ["Sun", "Sonne"],
  "sun.value": ["{azimuth}° around, {elevation}° high", "{azimuth}° herum, {elevation}° hoch"],
  "sun.title": [
    "Drag the sun around the tree; past the rim it goes behind. Hold it to keep it in place while the tree turns.",
    "Die Sonne um den Baum ziehen; über den Rand geht sie dahinter. Festgehalten bleibt sie stehen, während der Baum sich dreht.",
  ],
  "sun.pin": ["Keep the sun in place while the tree turns", "Sonne stehen lassen, während der Baum sich dreht"],
} as const;
