import { useEffect, useRef } from "preact/hooks";
import type { SheetName, Studio } from "../studio";
import { HelpSheet } from "./help-sheet";
import { LibrarySheet } from "./library-sheet";
import { Hint, ObstacleCard, ToastList } from "./notices";
import { SaveSheet } from "./save-sheet";
import { Seedling } from "./seedling";
import { ShareSheet } from "./share-sheet";
import { SideBar } from "./side-bar";
import { Status } from "./status";
import { TopBar } from "./top-bar";

const SHEETS: Record<SheetName, typeof SaveSheet> = {
  save: SaveSheet,
  library: LibrarySheet,
  share: ShareSheet,
  help: HelpSheet,
};

/** The whole page: the workspace, and around it as little as possible. */
export function App({ studio }: { studio: Studio }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    if (!canvas.current) {
      return undefined;
    }
    const detach = studio.attach(canvas.current);
    void studio.start();
    return detach;
  }, [studio]);
  const sheet = studio.sheet.value;
  const Open = sheet === null ? null : SHEETS[sheet];
  return (
    <div class="app" data-side={studio.settings.side.value} data-drawing={studio.drawing.value}>
      <canvas id="workspace" ref={canvas} aria-label="The tree. Draw to make it grow." role="img" />
      <Seedling studio={studio} />
      <SideBar studio={studio} />
      <TopBar studio={studio} />
      <Status studio={studio} />
      <Hint studio={studio} />
      <ObstacleCard studio={studio} />
      <ToastList studio={studio} />
      {Open !== null && <Open studio={studio} />}
    </div>
  );
}
