// The differences of a run from the one that is shown, as `skillc diff` finds them.
import { signal } from "@preact/signals";
import { api } from "../api/client";
import type { RunDiff } from "../api/types";
import { attempt } from "../state/actions";
import { operationId } from "../state/studio";

const comparison = signal<{ run: string; diff: RunDiff | null } | null>(null);

/** Compare a run with the one that is shown; a second time hides that again. */
export async function compare(run: string): Promise<void> {
  const shown = operationId.value;
  if (comparison.value?.run === run || shown === null) {
    comparison.value = null;
    return;
  }
  comparison.value = { run, diff: null };
  const done = await attempt(async () => (comparison.value = { run, diff: await api.diff(shown, run) }));
  if (!done) comparison.value = null;
}

export function Comparison({ run }: { run: string }) {
  if (comparison.value?.run !== run) return null;
  const { diff } = comparison.value;
  if (diff === null)
    return (
      <p class="row muted comparison">
        <span class="spinner" /> Comparing
      </p>
    );
  return (
    <div class="comparison stack small">
      {diff.differences.length === 0 && <p>No difference from the run that is shown.</p>}
      {diff.differences.length > 0 && (
        <table>
          <thead>
            <tr>
              <th>what differs</th>
              <th>shown</th>
              <th>this</th>
            </tr>
          </thead>
          <tbody>
            {diff.differences.slice(0, 100).map((each, index) => (
              <tr key={index}>
                <td>
                  <span class="muted">{each.part}</span> {each.what}
                </td>
                <td class="mono wrap-anywhere">{String(each.first ?? "–")}</td>
                <td class="mono wrap-anywhere">{String(each.second ?? "–")}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      {(diff.notes ?? []).map((each) => (
        <p key={each} class="muted">
          {each}
        </p>
      ))}
    </div>
  );
}
