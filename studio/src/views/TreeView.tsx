// The tree of the operation, live: only the rows in sight are drawn, whatever the size of the tree.
import { computed, signal } from "@preact/signals";
import { useEffect, useLayoutEffect, useMemo, useRef } from "preact/hooks";
import { activeCalls, ancestors } from "../state/operation";
import { treeRows, visibleRange, type TreeRow } from "../state/rows";
import { select } from "../state/actions";
import { operation, operationId, selection, shownRun } from "../state/studio";
import { describeFailure, formatTime, formatValue } from "../state/text";
import { Icon } from "./icons";
import { Panel } from "./Panel";
import { NodeMark } from "./status";

const ROW = 24;
const folds = signal<ReadonlyMap<number, boolean>>(new Map());
const showsAll = signal(false);
const filter = signal("");
const follows = signal(true);
const window_ = signal({ top: 0, height: 600 });

const rows = computed(() =>
  treeRows(operation.value, { all: showsAll.value, folds: folds.value, filter: filter.value }),
);

export function TreePanel() {
  return (
    <Panel name="tree" title="Tree" tools={<TreeTools />}>
      <TreeView />
    </Panel>
  );
}

function TreeTools() {
  return (
    <div class="row small">
      <input
        class="filter"
        type="search"
        placeholder="Filter"
        aria-label="Filter the tree"
        value={filter.value}
        onInput={(event) => (filter.value = event.currentTarget.value)}
      />
      <label class="row">
        <input type="checkbox" checked={showsAll.value} onChange={() => (showsAll.value = !showsAll.value)} />
        all nodes
      </label>
      <label class="row" title="Keep the running step in sight">
        <input type="checkbox" checked={follows.value} onChange={() => (follows.value = !follows.value)} />
        follow
      </label>
    </div>
  );
}

function TreeView() {
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    folds.value = new Map();
  }, [operationId.value]);
  useLayoutEffect(() => {
    const element = box.current;
    if (element === null) return;
    const measure = (): void => {
      window_.value = { top: element.scrollTop, height: element.clientHeight };
    };
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    element.addEventListener("scroll", measure, { passive: true });
    return () => {
      observer.disconnect();
      element.removeEventListener("scroll", measure);
    };
  }, []);
  useFollowing(box);
  useSelected(box);
  const all = rows.value;
  const [first, end] = visibleRange(window_.value.top, window_.value.height, ROW, all.length);
  const current = selection.value.kind === "node" ? selection.value.key : 0;
  return (
    <div
      ref={box}
      class="tree"
      role={all.length === 0 ? "group" : "tree"}
      aria-label="Tree of the operation"
      tabIndex={0}
      data-focus
      aria-activedescendant={
        all.slice(first, end).some((each) => each.key === current) ? `node-${current}` : undefined
      }
      onKeyDown={(event) => onKey(event, box.current)}
    >
      {all.length === 0 ? (
        <TreeEmpty />
      ) : (
        <div role="presentation" style={{ height: `${all.length * ROW}px`, position: "relative" }}>
          <div role="presentation" style={{ transform: `translateY(${first * ROW}px)` }}>
            {all.slice(first, end).map((each, index) => (
              <Row
                key={each.key}
                row={each}
                isSelected={each.key === current}
                position={first + index + 1}
                total={all.length}
              />
            ))}
          </div>
        </div>
      )}
    </div>
  );
}

function TreeEmpty() {
  if (filter.value !== "") return <div class="empty">No node has “{filter.value}” in its name.</div>;
  if (shownRun.value?.goesOn)
    return (
      <div class="empty">
        <span class="spinner" />
        No step has started yet. The tree appears with the first one.
      </div>
    );
  if (operation.value.ended !== null) return <div class="empty">It ended before any step was started.</div>;
  return (
    <div class="empty">
      Choose a task in the panel Run, and start it. Its tree is shown here while it runs.
    </div>
  );
}

interface RowProps {
  row: TreeRow;
  isSelected: boolean;
  position: number;
  total: number;
}

/** A row that is made anew only if what it shows has changed: of many in sight few do. */
function Row(props: RowProps) {
  const { row, isSelected, position, total } = props;
  const { node, depth, expandable, open } = row;
  return useMemo(
    () => <RowContent {...props} />,
    [node, depth, expandable, open, isSelected, position, total],
  );
}

function RowContent({ row, isSelected, position, total }: RowProps) {
  const { node } = row;
  const choice = node.choice;
  return (
    <div
      id={`node-${row.key}`}
      class={`tree-row is-${node.status}`}
      role="treeitem"
      aria-level={row.depth + 1}
      aria-selected={isSelected}
      aria-expanded={row.expandable ? row.open : undefined}
      aria-posinset={position}
      aria-setsize={total}
      style={{ paddingLeft: `${8 + row.depth * 16}px` }}
      onClick={() => select({ kind: "node", key: row.key })}
      onDblClick={() => row.expandable && fold(row, !row.open)}
    >
      <span
        class="twisty"
        aria-hidden="true"
        onClick={(event) => {
          if (!row.expandable) return;
          event.stopPropagation();
          fold(row, !row.open);
        }}
      >
        {row.expandable && <Icon name={row.open ? "open" : "closed"} />}
      </span>
      <NodeMark status={node.status} />
      <span class="node-name" title={choice?.skill ?? node.name}>
        {choice?.skill ?? node.name}
      </span>
      {choice !== null && <span class="node-choice">{choice.implementation}</span>}
      {node.runs > 1 && <span class="node-choice">× {node.runs}</span>}
      <span class="node-values truncate" title={describeNode(row)}>
        {describeNode(row)}
      </span>
      <span class="node-time mono">
        {node.status === "pending" ? "" : formatSpan(node.startedAt, node.endedAt)}
      </span>
    </div>
  );
}

function describeNode({ node }: TreeRow): string {
  if (node.status === "failure" && node.failure !== null) return describeFailure(node.failure);
  if (node.status === "pending") return node.values.join(", ");
  return node.choice === null ? "" : Object.values(node.choice.bindings).map(formatValue).join(", ");
}

function formatSpan(from: number, to: number | null): string {
  return to === null ? `from ${formatTime(from)}` : formatTime(to - from);
}

function fold(row: TreeRow, open: boolean): void {
  folds.value = new Map(folds.value).set(row.key, open);
}

/** Keep the innermost running call in sight, until a person scrolls or selects something. */
function useFollowing(box: { current: HTMLDivElement | null }): void {
  const active = activeCalls(operation.value).at(-1)?.key ?? 0;
  useEffect(() => {
    const element = box.current;
    const at = rows.peek().findIndex((each) => each.key === active);
    if (element === null || at < 0 || !follows.peek() || filter.peek() !== "") return;
    reveal(element, at);
  }, [active]);
}

/** Bring the selected node into sight, whichever panel it was selected in; what is folded around it is opened. */
function useSelected(box: { current: HTMLDivElement | null }): void {
  const key = selection.value.kind === "node" ? selection.value.key : 0;
  useEffect(() => {
    if (key === 0) return undefined;
    const isShown = rows.peek().some((each) => each.key === key);
    const around = [...ancestors(operation.peek().nodes, key)].map((each) => [each.key, true] as const);
    if (!isShown) folds.value = new Map([...folds.peek(), ...around]);
    // The list has its new height in the next frame.
    const frame = requestAnimationFrame(() => {
      const at = rows.peek().findIndex((each) => each.key === key);
      if (box.current !== null && at >= 0) reveal(box.current, at);
    });
    return () => cancelAnimationFrame(frame);
  }, [key]);
}

function reveal(element: HTMLElement, at: number): void {
  const [top, bottom] = [at * ROW, (at + 1) * ROW];
  if (top < element.scrollTop) element.scrollTop = Math.max(0, top - ROW);
  else if (bottom > element.scrollTop + element.clientHeight)
    element.scrollTop = bottom + ROW - element.clientHeight;
}

function onKey(event: KeyboardEvent, element: HTMLElement | null): void {
  const all = rows.value;
  const at = all.findIndex((each) => selection.value.kind === "node" && each.key === selection.value.key);
  const next = target(event.key, all, at);
  if (next === null || element === null) return;
  event.preventDefault();
  const row = all[next];
  if (row === undefined) return;
  follows.value = false;
  select({ kind: "node", key: row.key });
  reveal(element, next);
}

/** Return the index of the row that a key leads to; null if the key means nothing. Folds and opens on the way. */
function target(key: string, all: readonly TreeRow[], at: number): number | null {
  const row = all[at];
  switch (key) {
    case "ArrowDown":
      return Math.min(at + 1, all.length - 1);
    case "ArrowUp":
      return Math.max(at - 1, 0);
    case "Home":
      return 0;
    case "End":
      return all.length - 1;
    case "ArrowRight":
      if (row?.expandable && !row.open) fold(row, true);
      return row?.open ? Math.min(at + 1, all.length - 1) : at;
    case "ArrowLeft":
      if (row?.expandable && row.open) fold(row, false);
      else
        return Math.max(
          0,
          all.findLastIndex((each, index) => index < at && each.depth < (row?.depth ?? 0)),
        );
      return at;
    default:
      return null;
  }
}
