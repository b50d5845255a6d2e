// What `skillc why` says of the operation that is shown, and what it answers: sentences whose names are links.
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { api } from "../api/client";
import type { RunExplanation } from "../api/types";
import { attempt, select } from "../state/actions";
import { ATTEMPT, type TreeNode } from "../state/operation";
import { operation, operationId, replay } from "../state/studio";
import { LinkedLine } from "./LinkedLine";

const QUESTIONS = "2, 2.1, Pick, gripper, 2.gripper";

interface Asked {
  id: string;
  events: number;
  question: string;
  found: RunExplanation;
}

const explanation = signal<Asked | null>(null);
const question = signal("");

/** Ask about the operation that is shown; without a question, for the overview. */
async function ask(id: string): Promise<void> {
  const events = operation.peek().lastEvent;
  const asked = question.peek().trim();
  const found = await api.why(id, asked);
  if (operationId.peek() === id) explanation.value = { id, events, question: asked, found };
}

/** A field for questions with the answer, below what is said of the operation. */
export function Explanation() {
  const id = operationId.value;
  useEffect(() => {
    question.value = "";
    explanation.value = null;
  }, [id]);
  if (id === null || replay.value !== null) return null;
  const known = explanation.value?.found ?? null;
  return (
    <section class="details-section explanation">
      <h3>Ask why</h3>
      <form
        class="row"
        onSubmit={(event) => {
          event.preventDefault();
          void attempt(() => ask(id));
        }}
      >
        <input
          class="grow mono"
          aria-label="Question"
          placeholder={QUESTIONS}
          title="A step, a call inside it, a skill, an implementation or a parameter; nothing for an overview"
          value={question.value}
          onInput={(event) => (question.value = event.currentTarget.value)}
        />
        <button>Ask</button>
      </form>
      {known !== null && <Lines lines={known.answer.length > 0 ? known.answer : known.lines} known={known} />}
    </section>
  );
}

/** What `skillc why` says of a call; read when it is wanted, as the operation may be large. */
export function CallExplanation({ node }: { node: TreeNode }) {
  const id = operationId.value;
  if (id === null || replay.value !== null || operation.value.attempts.length !== 1) return null;
  const known = explanation.value?.id === id ? explanation.value : null;
  // The tree shows the last start of a node; each start is a call.
  const call = known?.found.calls.filter((each) => each.node === node.key % ATTEMPT).at(-1);
  const isNew = known?.events === operation.value.lastEvent;
  if (call === undefined || known === null || !isNew)
    return (
      <button class="link small" onClick={() => void attempt(() => ask(id))}>
        Explain in sentences
      </button>
    );
  return (
    <section class="details-section explanation">
      <h3>{`Call ${call.number}`}</h3>
      <Lines lines={call.lines} known={known.found} />
      <Origins id={id} number={call.number} parameters={call.parameters ?? []} />
      {(call.parameters ?? []).some((each) => known.question === `${call.number}.${each}`) && (
        <Lines lines={known.found.answer} known={known.found} />
      )}
    </section>
  );
}

/** Asks where the value of a parameter comes from, through every call. */
function Origins({ id, number, parameters }: { id: string; number: string; parameters: readonly string[] }) {
  if (parameters.length === 0) return null;
  const trace = (parameter: string): void => {
    question.value = `${number}.${parameter}`;
    void attempt(() => ask(id));
  };
  return (
    <p class="row wrap small origins">
      <span class="muted">Where does the value come from?</span>
      {parameters.map((each) => (
        <button
          key={each}
          class="link mono"
          title={`Follow ${each} to its expression and its line in the scene`}
          onClick={() => trace(each)}
        >
          {each}
        </button>
      ))}
    </p>
  );
}

function Lines({ lines, known }: { lines: readonly string[]; known: RunExplanation }) {
  const selectCall = (number: string): void => {
    const call = known.calls.find((each) => each.number === number);
    if (call?.node) select({ kind: "node", key: call.node });
  };
  // Numbers of nodes begin again with each plan.
  const hasOnePlan = operation.value.attempts.length === 1;
  const numbers = new Set(
    (hasOnePlan ? known.calls : []).filter((each) => each.node).map((each) => each.number),
  );
  return (
    <div class="explained small" role="status">
      {lines.map((each, index) => (
        <LinkedLine key={index} line={each} calls={numbers} onCall={selectCall} />
      ))}
    </div>
  );
}
