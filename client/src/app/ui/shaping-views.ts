export { PredictionBar, PredictionMarks } from "./bars/prediction-bar";
export { ToolOptions } from "./bars/tool-options";
export { BendMarks } from "./overlays/bend-marks";
export { BranchHandle } from "./overlays/branch-handle";
export { CutLineMark } from "./overlays/cut-line-mark";
export { WidthRings } from "./overlays/width-rings";
