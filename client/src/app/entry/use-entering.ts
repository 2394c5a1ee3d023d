import { useState } from "preact/hooks";
import { explained } from "../problems/explained";

/** Comes in by whatever gives the path to go to, and says why not where that fails. `begun`: somebody is about to. */
export function useEntering(begun: boolean) {
  const [entering, setEntering] = useState(begun);
  const [trouble, setTrouble] = useState("");
  const enter = async (come: () => Promise<string>) => {
    setEntering(true);
    setTrouble("");
    try {
      location.replace(await come());
    } catch (error) {
      setTrouble(await explained(error));
      setEntering(false);
    }
  };
  return { entering, trouble, enter, forgive: () => setTrouble("") };
}
