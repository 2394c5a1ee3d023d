import { useEffect, useMemo, useState } from "preact/hooks";
import { Directory } from "../../../access/directory";
import * as api from "../../../access/people-api";
import { Programs } from "../../../access/programs";
import { sentence } from "../../../problems/plain-words";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { GroupsTab } from "./groups-tab";
import { OwnTab } from "./own-tab";
import { PeopleTab } from "./people-tab";
import { ProgramsTab } from "./programs-tab";

/** For whoever says who comes in, and for everybody else. */
const TABS = ["people", "groups", "programs", "own"] as const;
const OWN_TABS = ["programs", "own"] as const;
/** Who was let in for one tree is asked for neither. */
const GUEST_TABS = ["own"] as const;
type Tab = (typeof TABS)[number];

/** Who can log in, groups, programs, and one's own account. */
export function AccountsSheet({ studio }: { readonly studio: Studio }) {
  const says = studio.rights.mayChangePeople;
  const tabs: readonly Tab[] = says ? TABS : studio.rights.mayOwnTokens ? OWN_TABS : GUEST_TABS;
  const [tab, setTab] = useState<Tab>(says ? "people" : "own");
  const { directory, programs } = useMemo(() => {
    const options = { api, failed: (error: unknown) => studio.toasts.show(sentence(error)) };
    return { directory: new Directory(options), programs: new Programs(options) };
  }, [studio]);
  useEffect(() => {
    if (says) {
      void directory.look();
    }
  }, [directory, says]);
  return (
    <div class="stack">
      <div
        class="tabs account-tabs"
        role="tablist"
        aria-label={say("accounts.tabs")}
        style={{ "--tabs": tabs.length }}
        onKeyDown={(event) => {
          const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
          if (by !== undefined) {
            const next = tabs[(tabs.indexOf(tab) + by + tabs.length) % tabs.length] ?? tab;
            setTab(next);
            document.getElementById(`accounts-tab-${next}`)?.focus();
            event.preventDefault();
          }
        }}
      >
        {tabs.map((name) => (
          <button
            type="button"
            role="tab"
            key={name}
            id={`accounts-tab-${name}`}
            aria-selected={tab === name}
            aria-controls="accounts-shown"
            tabIndex={tab === name ? 0 : -1}
            onClick={() => setTab(name)}
          >
            {say(`accounts.tab.${name}`)}
          </button>
        ))}
      </div>
      <div id="accounts-shown" role="tabpanel" aria-labelledby={`accounts-tab-${tab}`}>
        {tab === "own" && <OwnTab studio={studio} />}
        {tab === "programs" && <ProgramsTab studio={studio} programs={programs} />}
        {(tab === "people" || tab === "groups") && <Listed studio={studio} directory={directory} tab={tab} />}
      </div>
    </div>
  );
}

interface ListedProps {
  readonly studio: Studio;
  readonly directory: Directory;
  readonly tab: "people" | "groups";
}

/** People or groups once they are known, or why they are not. */
function Listed({ studio, directory, tab }: ListedProps) {
  const failure = directory.failure.value;
  if (failure !== null) {
    return (
      <div class="actions">
        <p role="alert">{sentence(failure)}</p>
        <button type="button" class="small" onClick={() => void directory.look()}>
          {say("sheets.library.again")}
        </button>
      </div>
    );
  }
  if (directory.users.value === null) {
    return <p class="quiet">{say("accounts.loading")}</p>;
  }
  const View = tab === "people" ? PeopleTab : GroupsTab;
  return <View studio={studio} directory={directory} />;
}
