interface ModuleGraph {
  getModuleInfo(id: string): { readonly importedIds: readonly string[] } | null;
}

/**
 * Names the file of a module: one for all that the page loads at once, for in several it compresses worse. `entry` is
 * where the page begins.
 */
export function firstPictureChunk(entry: string): (id: string, graph: ModuleGraph) => string | null {
  let loaded: ReadonlySet<string> | null = null;
  return (id, graph) => {
    loaded ??= loadedWith(entry, graph);
    return loaded.has(id) ? "index" : null;
  };
}

/** The modules that are loaded with a module, itself among them. */
function loadedWith(entry: string, graph: ModuleGraph): ReadonlySet<string> {
  const loaded = new Set<string>();
  const waiting = [entry];
  for (let next = waiting.pop(); next !== undefined; next = waiting.pop()) {
    if (!loaded.has(next)) {
      loaded.add(next);
      waiting.push(...(graph.getModuleInfo(next)?.importedIds ?? []));
    }
  }
  return loaded;
}
