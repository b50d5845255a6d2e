// The events of the operation as lines; a click selects the node or the moment.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { select } from "../state/actions";
import type { LogEntry } from "../state/log";
import { visibleRange } from "../state/rows";
import { operation, selection } from "../state/studio";

const ROW = 22;

export function EventsView() {
  const box = useRef<HTMLDivElement>(null);
  const atEnd = useRef(true);
  const [range, setRange] = useState({ top: 0, height: 400 });
  const { log } = operation.value;
  const measure = (): void => {
    const element = box.current;
    if (element === null) return;
    atEnd.current = element.scrollHeight - element.scrollTop - element.clientHeight < ROW * 2;
    setRange({ top: element.scrollTop, height: element.clientHeight });
  };
  useLayoutEffect(() => {
    const element = box.current;
    if (element === null) return;
    if (atEnd.current) element.scrollTop = element.scrollHeight;
    measure();
  }, [log.length]);
  if (log.length === 0) return <div class="empty">Nothing has happened yet.</div>;
  const [first, end] = visibleRange(range.top, range.height, ROW, log.length);
  return (
    <div
      class="events"
      ref={box}
      onScroll={measure}
      tabIndex={0}
      data-focus
      role="log"
      aria-label="Events"
      aria-live="off"
    >
      <div style={{ height: `${log.length * ROW}px` }}>
        <ol style={{ transform: `translateY(${first * ROW}px)` }}>
          {log.slice(first, end).map((each) => (
            <EventRow key={each.sequence} entry={each} />
          ))}
        </ol>
      </div>
    </div>
  );
}

const WORDS = { info: "", good: "", bad: "!", world: "world", command: "person" };

function EventRow({ entry }: { entry: LogEntry }) {
  const current = selection.value;
  const isSelected =
    (current.kind === "node" && current.key === entry.node) ||
    (current.kind === "time" && current.time === entry.time);
  const choose = (): void =>
    select(entry.node === 0 ? { kind: "time", time: entry.time } : { kind: "node", key: entry.node });
  return (
    <li class={`event is-${entry.severity}`}>
      <button class="event-button" aria-pressed={isSelected} title={entry.text} onClick={choose}>
        <span class="mono muted event-time">{entry.time.toFixed(1)} s</span>
        <span class="event-kind">{WORDS[entry.severity]}</span>
        <span class="truncate">{entry.text}</span>
      </button>
    </li>
  );
}
