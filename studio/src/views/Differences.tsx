// What differs between two runs, part by part in the order in which one may cause another, as `skillc diff` says it.
import { useState } from "preact/hooks";
import type { RunDiff } from "../api/types";
import { PARTS, type Part } from "../state/comparison";
import { formatNumber } from "../state/text";

const NAMES: Record<Part, string> = {
  settings: "Settings",
  requests: "Requests",
  plan: "Plan",
  choices: "Choices",
  outcomes: "Outcomes",
  measures: "Figures",
  times: "Times, in s",
  signals: "Signals, in parts of their range",
};
const SHOWN = 100;
const LONG = 80;

export function Differences({ diff }: { diff: RunDiff }) {
  const parts = PARTS.map((part) => ({
    part,
    found: diff.differences.filter((each) => each.part === part),
    compared: diff.compared[part] ?? 0,
  }));
  const same = parts.filter((each) => each.found.length === 0 && each.compared > 0);
  return (
    <section class="differences stack" aria-label="Differences">
      <h3>{diff.differences.length === 0 ? "No difference" : "What differs"}</h3>
      {same.length > 0 && (
        <p class="small muted">
          The same:{" "}
          {same
            .map((each) => `${NAMES[each.part].split(",")[0]?.toLowerCase() ?? ""} (${each.compared})`)
            .join(", ")}
        </p>
      )}
      {parts
        .filter((each) => each.found.length > 0)
        .map((each) => (
          <PartTable key={each.part} name={NAMES[each.part]} found={each.found} compared={each.compared} />
        ))}
      {(diff.notes ?? []).map((each) => (
        <p key={each} class="small muted">
          {each}
        </p>
      ))}
    </section>
  );
}

interface PartTableProps {
  name: string;
  found: RunDiff["differences"];
  compared: number;
}

function PartTable({ name, found, compared }: PartTableProps) {
  return (
    <table>
      <thead>
        <tr>
          <th scope="col">
            {name} <span class="small">{`${found.length} differ, ${compared} compared`}</span>
          </th>
          <th scope="col">A</th>
          <th scope="col">B</th>
        </tr>
      </thead>
      <tbody>
        {found.slice(0, SHOWN).map((each, index) => (
          <tr key={index}>
            <td class="wrap-anywhere">{each.what}</td>
            <ValueCell text={format(each.first)} />
            <ValueCell text={format(each.second)} />
          </tr>
        ))}
        {found.length > SHOWN && (
          <tr>
            <td colSpan={3} class="muted">{`and ${found.length - SHOWN} more`}</td>
          </tr>
        )}
      </tbody>
    </table>
  );
}

function ValueCell({ text }: { text: string }) {
  const [isWhole, setIsWhole] = useState(false);
  if (text.length <= LONG || isWhole) return <td class="mono wrap-anywhere">{text}</td>;
  return (
    <td class="mono wrap-anywhere">
      {text.slice(0, LONG)}
      <button class="link" aria-label="Show the whole value" onClick={() => setIsWhole(true)}>
        …
      </button>
    </td>
  );
}

function format(value: string | number | boolean | null): string {
  if (value === null) return "–";
  return typeof value === "number" ? formatNumber(value, 4) : String(value);
}
