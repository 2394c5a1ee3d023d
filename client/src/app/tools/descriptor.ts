import type { ReadonlySignal } from "@preact/signals";
import type { ComponentType, VNode } from "preact";
import type { Girth } from "../../scene/overlay/width-overlay";
import type { TreeTable } from "../../scene/table/tree-table";
import type { Vec3 } from "../../scene/vector";
import type { Viewport } from "../../scene/viewport";
import type { Command } from "../../wire/generated";
import type { ObstacleList } from "../document/obstacles/obstacle-list";
import type { PlaceName } from "../help/help-places";
import type { StrokePoint } from "../input/gesture-recogniser";
import type { Settings } from "../page/settings";
import type { Toasts } from "../page/toasts";
import type { Stage } from "../view/stage";
import type { Key, Text } from "../words/say";
import type { SharedBends } from "./bend/shared-bends";
import type { BranchWork } from "./branch/branch-work";
import type { HeldBranch } from "./branch/held-branch";
import type { StrokeTrail } from "./brush/stroke-trail";
import type { ChosenBud } from "./chosen-bud";
import type { OutlineTrace } from "./lasso/outline-trace";
import type { Copy } from "./symmetry/symmetry";
import type { GripTool, StrokeTool } from "./tool";
import type { WidthList } from "./width/width-list";

/** A tool that has the pointers while it is chosen. */
export type AnyTool = StrokeTool | GripTool;

/** What other parts of the page ask a tool for. */
export type Service = "cut" | "bend" | "plant";

/** What takes a finger before the chosen tool does, where it lies on something of its own. */
export interface Mover extends StrokeTool {
  /** Whether a stroke that begins here is its own. */
  grips(point: StrokePoint): boolean;
}

/** Everything that the page shows and says of a tool, and how the tool is made: one for each tool, beside its code. */
export interface ToolDescriptor<Made extends AnyTool = AnyTool> {
  /** The letter that chooses it, as it stands on the key. */
  readonly key: string;
  readonly label: Text;
  /** What it does, in a line; the key is added to it. */
  readonly title: Text;
  readonly Icon: ComponentType<{ readonly settings: Settings }>;
  /** The group of the help that it stands in. */
  readonly group: "drawing" | "shaping";
  /** Its code is there with the first picture. */
  readonly atOnce?: boolean;
  /** What the page asks it for, whichever tool is chosen. */
  readonly serves?: Service;
  /** Holding still chooses the branch there, and a double tap cuts it off. */
  readonly choosesBranches?: boolean;
  /** It keeps a finger on an obstacle, which otherwise moves the obstacle while the scene is arranged. */
  readonly keepsObstacles?: boolean;
  /** The tree grows while it draws. */
  readonly growsIntoStrokes?: boolean;
  /** What it draws is repeated as the symmetry has it. */
  readonly isSymmetric?: boolean;
  /** Its strokes go through the whole tree, which rests for them. */
  readonly stillsTree?: boolean;
  /** It works with the brush's radius. */
  readonly usesRadius?: boolean;
  /** What to do first, as long as the user has not done it. */
  readonly hint?: (facts: HintFacts) => Text | null;
  /** A promise where the first picture does without the tool's code, which is then loaded when it is first needed. */
  readonly make: (kit: ToolKit) => Made | Promise<Made>;
  /** Called once the tool is in use, which it may not become where the view has gone while its code was loaded. */
  ready?(tool: Made, kit: ToolKit): void;
  /** `later` has options or marks, which are needed as soon as the tool is chosen. */
  readonly hasViews?: boolean;
  /** What the first picture does without. */
  later(): Promise<ToolLater<Made>>;
}

/** What a hint depends on. */
export interface HintFacts {
  readonly settings: Settings;
  /** Whether an outline is shown. */
  readonly outlined: boolean;
  /** Whether the tree has no metamers yet. */
  readonly empty: boolean;
}

/** The part of a tool that is loaded when it is first needed. */
export interface ToolLater<Made extends AnyTool = AnyTool> {
  readonly HELP: readonly ToolTopic[];
  /** The labels of its options that have a sentence of help. */
  readonly CONTROLS?: readonly Key[];
  /** The options at the bottom of the page. */
  Options?(props: ToolViewProps<Made>): VNode | null;
  /** What lies over the picture. */
  Marks?(props: ToolViewProps<Made>): VNode | null;
}

export interface ToolViewProps<Made extends AnyTool = AnyTool> {
  readonly tool: Made;
  readonly page: ToolPage;
}

/** The parts of a page that options and marks use. */
export interface ToolPage {
  readonly settings: Settings;
  readonly table: TreeTable;
  readonly stage: Stage;
  readonly branches: BranchWork;
  /** Changes with each frame of rows. */
  readonly revision: ReadonlySignal<number>;
}

/** An entry of the help about a tool. */
export interface ToolTopic {
  readonly name: string;
  readonly title: Text;
  readonly text: Text;
  /** Other words for it, by which it is found. */
  readonly words: Text;
  /** What it shows, where that is not the tool itself. */
  readonly place?: PlaceName;
}

/** What the tools work with. */
export interface Workshop {
  readonly table: TreeTable;
  readonly settings: Settings;
  readonly toasts: Toasts;
  readonly bud: ChosenBud;
  readonly obstacles: ObstacleList;
  readonly branch: HeldBranch;
  readonly outline: OutlineTrace;
  readonly trail: StrokeTrail;
  readonly widths: WidthList;
  readonly bends: SharedBends;
  readonly submit: (command: Command) => void;
  /** The number the next command gets. */
  readonly next: () => number;
  /** How many `stroke_move` the server has still to answer or to grow. */
  readonly unsettledMoves: () => number;
  /** How many commands of a kind the server has still to answer. */
  readonly unsettled: (kind: Command["kind"]) => number;
  /** What the wood's width follows from. */
  readonly girth: () => Girth;
  /** Shows what would become of the tree without the branches at these rows. */
  readonly predict: (rows: readonly number[]) => void;
}

/** What a tool is made from. */
export interface ToolKit extends Workshop {
  readonly view: Viewport;
  /** Where in depth something lies that begins beside every branch. */
  readonly base: (x: number, y: number) => Vec3;
  /** What is drawn from a place on the canvas, on the branch of a row or beside every branch, and its repetitions. */
  readonly copies: (row: number | null, x: number, y: number) => readonly Copy[];
  /** Tells the user something. */
  readonly say: (text: Key | Text) => void;
}
