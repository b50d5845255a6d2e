// Arriving at the page: logging in with the code in its address, then showing the cell and the task that this names.
import { effect, signal, untracked } from "@preact/signals";
import { api, ApiError } from "../api/client";
import { attempt, showCell } from "../state/actions";
import { readFragment, writeFragment, type Asked } from "../state/address";
import { comparison } from "../state/comparison";
import { endReplay } from "../state/replay";
import { cellName, message, session } from "../state/studio";
import { shownSeries } from "../state/trials";
import { choosing, runTab, wantedTask } from "./layout";

/** Why the code of the address has not logged in; empty if it has, or there was none. */
export const codeProblem = signal("");
/** The cell and the task of the address, until somebody is logged in and sees them. */
const asked = signal<Omit<Asked, "code"> | null>(null);

/** Log in with the code of the address, which is taken out of it, and find out who is logged in. */
export async function arrive(): Promise<void> {
  const { code, cell, task } = readFragment(location.hash);
  setFragment(writeFragment({ cell, task }));
  const problem = code === null ? "" : await useCode(code);
  const who = await api.session().catch(() => null);
  codeProblem.value = who === null ? problem : "";
  session.value = who;
  if (who !== null && problem !== "")
    message.value = { kind: "error", text: `${problem} You are still logged in as ${who.name}.` };
  asked.value = cell === null && task === null ? null : { cell, task };
}

/** Use a code up; return why that has not logged in, as a sentence. */
async function useCode(code: string): Promise<string> {
  try {
    await api.logIn(code);
    return "";
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    if (error.status !== 401) return `The code in the address has not logged you in: ${error.message}.`;
    return "The code in the address is wrong, was used before, or is older than a minute.";
  }
}

/** Show what the address asks for, as soon as it asks; the function that is returned ends that. */
export function followAsked(): () => void {
  return effect(() => {
    const wanted = asked.value;
    if (wanted !== null) untracked(() => void showAsked(wanted));
  });
}

async function showAsked({ cell, task }: Omit<Asked, "code">): Promise<void> {
  const before = message.peek();
  const isThere = cell === null || (await attempt(() => chooseCell(cell)));
  asked.value = null;
  setFragment("");
  if (!isThere) return;
  message.value = before;
  if (task === null) return;
  endReplay();
  [comparison.value, shownSeries.value] = [null, null];
  wantedTask.value = task;
  choosing.value = true;
  runTab.value = "run";
}

async function chooseCell(name: string): Promise<void> {
  const names = (await api.cells()).map((each) => each.name);
  if (!names.includes(name))
    throw new ApiError(404, `There is no cell ${name}; the server has ${names.join(", ")}.`);
  if (cellName.peek() !== name) showCell(name);
}

function setFragment(fragment: string): void {
  if (location.hash !== fragment) history.replaceState(null, "", location.pathname + fragment);
}
