/** The strip that turns the tree. */
export const ROTATION = {
  "rotation.label": ["Turn the tree", "Baum drehen"],
  "rotation.value": ["{degrees}°", "{degrees}°"],
  "rotation.title": [
    "Turn the tree, also while the other hand draws",
    "Den Baum drehen, auch während die andere Hand zeichnet",
  ],
} as const;
