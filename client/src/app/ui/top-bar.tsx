import { gltfAddress } from "../library-api";
import type { Studio } from "../studio";
import { DownloadIcon, GrowthIcon, HelpIcon, LibraryIcon, NewIcon, SaveIcon, SceneIcon, ShareIcon } from "./icons";

/** What is done with a tree as a whole. */
export function TopBar({ studio }: { studio: Studio }) {
  const session = studio.session.value;
  return (
    <header class="panel top-bar">
      <button
        type="button"
        class="tool"
        aria-label="Growth"
        title="Growth: species and parameters"
        aria-pressed={studio.panel.value === "growth"}
        onClick={() => studio.togglePanel("growth")}
      >
        <GrowthIcon />
      </button>
      <button
        type="button"
        class="tool"
        aria-label="Scene"
        title="Scene: obstacles and seeds"
        aria-pressed={studio.panel.value === "scene"}
        onClick={() => studio.togglePanel("scene")}
      >
        <SceneIcon />
      </button>
      <hr />
      <button type="button" class="tool" aria-label="New tree" title="New tree" onClick={() => studio.newSession()}>
        <NewIcon />
      </button>
      <button type="button" class="tool" aria-label="Save" title="Save" onClick={() => open(studio, "save")}>
        <SaveIcon />
      </button>
      <button type="button" class="tool" aria-label="Library" title="Library" onClick={() => open(studio, "library")}>
        <LibraryIcon />
      </button>
      <button type="button" class="tool" aria-label="Share" title="Share" onClick={() => open(studio, "share")}>
        <ShareIcon />
      </button>
      <a
        class="tool"
        aria-label="Download as glTF"
        title="Download as glTF"
        href={session === null ? undefined : gltfAddress(session)}
        download={`${session ?? "tree"}.glb`}
      >
        <DownloadIcon />
      </a>
      <button type="button" class="tool" aria-label="Help" title="Help (?)" onClick={() => open(studio, "help")}>
        <HelpIcon />
      </button>
    </header>
  );
}

function open(studio: Studio, sheet: "save" | "library" | "share" | "help") {
  studio.sheet.value = sheet;
}
