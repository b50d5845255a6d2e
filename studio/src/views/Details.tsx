// Why: the selected node with its implementation, its values and its failure, each with reasons; otherwise the operation.
import type { ComponentChildren } from "preact";
import type { Failure, ImplementationChosen, Rejection, TaskEnded } from "../api/types";
import { select } from "../state/actions";
import { activeCalls, ancestors, type TreeNode } from "../state/operation";
import { selectedNode } from "../state/selection";
import { nameOperations } from "../state/activity";
import { operation, selection, shownRun } from "../state/studio";
import { formatTime } from "../state/text";
import { CallExplanation, Explanation } from "./Explanation";
import { Fact, PlaceLink, ThingLink, Value } from "./links";
import { FalseClaims, nodeWord, NodeMark, RunBadge, toneOfEnd } from "./status";
import { KnownFacts } from "./KnownFacts";
import { ThingDetails } from "./ThingDetails";

export function Details() {
  const node = selectedNode(selection.value, operation.value);
  return <div class="details">{node !== null ? <NodeDetails node={node} /> : <OtherDetails />}</div>;
}

function OtherDetails() {
  const current = selection.value;
  if (current.kind === "thing") return <ThingDetails iri={current.iri} />;
  return <OperationDetails />;
}

function Section({ title, children }: { title: string; children: ComponentChildren }) {
  return (
    <section class="details-section">
      <h3>{title}</h3>
      {children}
    </section>
  );
}

/** Why the operation is as it is: what it does now, or how and why it ended. */
function OperationDetails() {
  const { ended, reason, state } = operation.value;
  if (state === null && shownRun.value === null)
    return <div class="empty">Select a node, a thing or a moment, and here is why it is so.</div>;
  const waits = shownRun.value?.reason ?? reason;
  return (
    <>
      {state !== null && (
        <p class="row">
          <RunBadge state={state} {...judge(ended)} />
          {waits !== "" && ended === null && <span class="wrap-anywhere">{nameOperations(waits)}</span>}
        </p>
      )}
      {ended?.failure != null && <FailureText failure={ended.failure} tone={toneOfEnd(state)} />}
      {ended !== null && ended.status === "failed" && <FailedNodes />}
      <Running
        title={ended === null ? "What runs now" : "What ran when it ended"}
        active={activeCalls(operation.value)}
      />
      {ended !== null && <Grounds ended={ended} />}
      <Explanation />
      <p class="muted small">Select a node of the tree, a thing or a moment: here is why it is so.</p>
    </>
  );
}

function Running({ title, active }: { title: string; active: readonly TreeNode[] }) {
  if (active.length === 0) return null;
  return (
    <Section title={title}>
      <ul class="stack">
        {active.map((each) => (
          <li key={each.key}>
            <CallPath node={each} />
          </li>
        ))}
      </ul>
    </Section>
  );
}

function judge(ended: TaskEnded | null) {
  return { asks: shownRun.value?.asks ?? false, verified: ended?.verified, claims: ended?.false_claims };
}

/** What of the claims at the end is false; then the facts that a success rests on, and how each is known. */
function Grounds({ ended }: { ended: TaskEnded }) {
  const facts = ended.facts ?? [];
  if (facts.length === 0) return <FalseClaims claims={ended.false_claims} />;
  return (
    <>
      <FalseClaims claims={ended.false_claims} />
      <Section
        title={`The facts that this rests on${ended.verified === false ? "; some are only assumed" : ""}`}
      >
        <KnownFacts facts={facts} />
      </Section>
    </>
  );
}

/** The innermost nodes that failed: a click leads to where it began. */
function FailedNodes() {
  const { nodes } = operation.value;
  const failed = [...nodes.values()].filter((each) => each.status === "failure");
  const first = failed.filter((each) => !each.children.some((key) => nodes.get(key)?.status === "failure"));
  if (first.length === 0) return null;
  return (
    <Section title="Where it failed">
      <ul class="stack">
        {first.slice(-5).map((each) => (
          <li key={each.key} class="row">
            <CallPath node={each} />
            <PlaceLink place={each.source} />
          </li>
        ))}
      </ul>
    </Section>
  );
}

/** The calls around a node, from the outside in, as links. */
function CallPath({ node }: { node: TreeNode }) {
  const path = [node, ...ancestors(operation.value.nodes, node.key)].filter(
    (each) => each.kind === "call" || each === node,
  );
  return (
    <span class="call-path">
      {path.reverse().map((each, index) => (
        <span key={each.key}>
          {index > 0 && <span class="muted"> › </span>}
          <button class="link" onClick={() => select({ kind: "node", key: each.key })}>
            {each.choice?.skill ?? each.name}
          </button>
        </span>
      ))}
    </span>
  );
}

function NodeDetails({ node }: { node: TreeNode }) {
  return (
    <>
      <p class="row">
        <NodeMark status={node.status} />
        <strong>
          {node.choice === null ? node.name : `${node.choice.skill}[${node.choice.implementation}]`}
        </strong>
        <span class="muted">{nodeWord(node.status)}</span>
        <span class="grow" />
        <PlaceLink place={node.source} />
      </p>
      <p class="small muted">
        <CallPath node={node} />
        {` · ${node.kind}`}
        {node.status !== "pending" && ` · starts at ${formatTime(node.startedAt)} (event ${node.startEvent})`}
        {node.endedAt !== null &&
          `, takes ${formatTime(node.endedAt - node.startedAt)}${node.endEvent === null ? "" : ` (event ${node.endEvent})`}`}
      </p>
      {node.failure !== null && <FailureText failure={node.failure} />}
      {node.failedCall !== null && (node.failedCall.facts ?? []).length > 0 && (
        <Section title="The facts then">
          <ul>
            {(node.failedCall.facts ?? []).map((each, index) => (
              <li key={index}>
                <Fact fact={each} />
              </li>
            ))}
          </ul>
        </Section>
      )}
      {node.failedCall !== null && <Rejected rejected={node.failedCall.rejected ?? []} />}
      {node.choice !== null && <Choice choice={node.choice} />}
      {node.kind === "call" && node.status !== "pending" && <CallExplanation node={node} />}
    </>
  );
}

function FailureText({ failure, tone = "bad" }: { failure: Failure; tone?: "bad" | "" }) {
  return (
    <div class={`notice ${tone} stack`}>
      <p>{failure.message}</p>
      {failure.detail && <p class="small">{failure.detail}</p>}
      {failure.source != null && (
        <p class="small">
          at <PlaceLink place={failure.source} />
          {failure.skill ? ` in ${failure.skill}` : ""}
        </p>
      )}
      <Causes causes={failure.causes ?? []} above={failure.message} />
    </div>
  );
}

/** What a failure came from, as a list: each way that was tried with its place; what is said above is not repeated. */
function Causes({ causes, above }: { causes: readonly Failure[]; above: string }) {
  if (causes.length === 0) return null;
  return (
    <ul class="causes small">
      {causes.map((each, index) => (
        <li key={index}>
          {each.alternative ? `${each.alternative}: ` : ""}
          {each.message !== above ? each.message : each.source != null ? "the same at" : "the same"}{" "}
          {each.source != null && <PlaceLink place={each.source} />}
          <Causes causes={each.causes ?? []} above={each.message} />
        </li>
      ))}
    </ul>
  );
}

function Choice({ choice }: { choice: ImplementationChosen }) {
  const untried = choice.untried ?? [];
  const rejected = choice.rejected ?? [];
  const others = untried.length + rejected.length;
  return (
    <>
      <Section title={`Why ${choice.implementation}`}>
        <p>
          {choice.fixed
            ? "The call names this implementation."
            : others === 0
              ? `${choice.skill} has no other implementation.`
              : "It is the first one in the order of the library that could start."}
        </p>
        <Rejected rejected={rejected} />
        {untried.map((each) => (
          <p key={each.implementation} class="small">
            <span class="mono">{each.implementation}</span> ranks after it
            {each.reason ? `, and could not start: ${each.reason}` : ""} <PlaceLink place={each.source} />
          </p>
        ))}
      </Section>
      {Object.keys(choice.bindings).length > 0 && (
        <Section title="Values">
          <dl class="values">
            {Object.entries(choice.bindings).map(([name, value]) => (
              <Parameter key={name} name={name} choice={choice} value={<Value value={value} />} />
            ))}
          </dl>
        </Section>
      )}
    </>
  );
}

function Parameter({
  name,
  choice,
  value,
}: {
  name: string;
  choice: ImplementationChosen;
  value: ComponentChildren;
}) {
  const reason = (choice.determined ?? []).find((each) => each.parameter === name);
  return (
    <>
      <dt class="mono">{name}</dt>
      <dd>
        {value} <span class="muted small">{reason === undefined ? "passed" : reason.how}</span>
        {(reason?.conditions ?? []).map((each, index) => (
          <div key={index} class="small reason">
            because <span class="mono">{each.text}</span> <PlaceLink place={each.source} />
            {each.facts.length > 0 && ": "}
            {each.facts.map((fact, at) => (
              <span key={at}>
                {at > 0 && ", "}
                <Fact fact={fact} />
              </span>
            ))}
          </div>
        ))}
        {(reason?.others ?? []).length > 0 && (
          <div class="small reason">
            others:{" "}
            {(reason?.others ?? []).map((each) => (
              <ThingLink key={each.iri} thing={each} />
            ))}
          </div>
        )}
      </dd>
    </>
  );
}

function Rejected({ rejected }: { rejected: readonly Rejection[] }) {
  return (
    <>
      {rejected.map((each, index) => (
        <p key={index} class="small">
          <span class="mono">{each.implementation}</span> was rejected ({each.stage}): {each.reason}{" "}
          <PlaceLink place={each.source} />
        </p>
      ))}
    </>
  );
}
