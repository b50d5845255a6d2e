// A series of trials: how many passed, each measure as a distribution, and the worst case one click from its replay.
import { useState } from "preact/hooks";
import type { Series, Spread } from "../api/types";
import { goesOn } from "../state/jobs";
import { may } from "../state/studio";
import { formatStart } from "../state/run_times";
import { formatNumber } from "../state/text";
import {
  describeDisturbance,
  dotsOf,
  playTrial,
  removeSeries,
  replayed,
  shownSeries,
  worstOf,
  type Trials,
} from "../state/trials";
import { FullPage } from "./FullPage";

interface Shown {
  about: Trials;
  result: Series | null;
}

export function TrialsPage({ series: { about, result } }: { series: Shown }) {
  const close = (): void => {
    replayed.value = null;
    shownSeries.value = null;
  };
  return (
    <FullPage
      title={`Trials of ${result?.task ?? about.request.task}`}
      onClose={close}
      tools={<Tools about={about} />}
    >
      {result === null ? (
        <div class="empty" role="status">
          <span class="spinner" />
          The trials are judged
        </div>
      ) : result.done === 0 ? (
        <div class="empty">{about.reason || "No trial is done yet."}</div>
      ) : (
        <div class="trials">
          <Summary about={about} result={result} />
          <section class="stack" aria-label="Distributions">
            <div class="trials-legend">
              <h3>What was measured</h3>
              <Legend spreads={result.spreads} />
            </div>
            {result.spreads.map((each) => (
              <Distribution
                key={`${each.subject} ${each.metric}`}
                about={about}
                spread={{
                  ...each,
                  seeds: each.seeds ?? [],
                  sense: each.sense ?? "at-most",
                  median_missed: each.median_missed ?? null,
                }}
                failed={new Set(result.failed.map((one) => one.seed))}
              />
            ))}
          </section>
        </div>
      )}
    </FullPage>
  );
}

/** How distributions are read. */
function Legend({ spreads }: { spreads: Series["spreads"] }) {
  if (spreads.length === 0) return <p class="muted">Nothing was measured in these trials.</p>;
  return (
    <p class="small muted">
      A dot is a trial; click it to replay it. The box holds the middle half of the values, the line is their
      median. <span class="is-waiting">The worst value</span> and <span class="is-bad">failed trials</span>{" "}
      have colours of their own
      {spreads.some((each) => each.bound !== null) && "; a dashed line is what is wanted"}.
    </p>
  );
}

function Tools({ about }: { about: Trials }) {
  const [isAsking, setIsAsking] = useState(false);
  if (isAsking)
    return (
      <div class="row" role="group" aria-label="Forget the series">
        <span>Forget {about.done} trials for good?</span>
        <button class="primary" ref={takeKeyboard} onClick={() => void removeSeries(about)}>
          Forget them
        </button>
        <button onClick={() => setIsAsking(false)}>Keep them</button>
      </div>
    );
  return (
    <button
      disabled={!may("operate")}
      title={may("operate") ? "Its results are lost" : "This needs the role operate"}
      onClick={() => setIsAsking(true)}
    >
      {goesOn(about) ? "End and forget" : "Forget"}
    </button>
  );
}

const takeKeyboard = (element: HTMLElement | null): void => element?.focus();

function Summary({ about, result }: { about: Trials; result: Series }) {
  const percent = (share: number): string => `${Math.round(share * 100)} %`;
  const interval = result.pass_interval;
  return (
    <section class="stack trials-summary" aria-label="Summary">
      <About series={about} />
      <h3>Passed</h3>
      <p class={`trials-share ${result.passed === result.done ? "is-good" : "is-bad"}`}>
        {result.passed} of {result.done}
      </p>
      {interval !== null && (
        <p class="small muted">
          With 95 % confidence {percent(interval.low)} to {percent(interval.high)} of all trials pass.
        </p>
      )}
      {result.done < result.wanted && (
        <>
          <progress aria-label="Trials that are done" max={result.wanted} value={result.done} />
          <p class="small muted">
            {result.done} of {result.wanted} are done. {about.reason}
          </p>
        </>
      )}
      {result.unverified > 0 && (
        <p class="small is-waiting">
          {result.unverified} finished, not verified. Assumed: {result.assumed.slice(0, 4).join("; ")}
          {result.assumed.length > 4 && ` and ${result.assumed.length - 4} more`}
        </p>
      )}
      {result.false_successes > 0 && (
        <p class="small is-bad">
          {result.false_successes} succeeded although the world model claims something false.
        </p>
      )}
      {result.failed.length > 0 && <h3>Failed</h3>}
      <ul class="stack">
        {result.failed.map((each) => (
          <li key={each.seed} class="stack trials-failed">
            <span class="row spread">
              <span>✗ seed {each.seed}</span>
              <ReplayButton about={about} seed={each.seed} />
            </span>
            {each.reasons.map((reason) => (
              <span key={reason} class="small wrap-anywhere">
                {reason}
              </span>
            ))}
            {each.variation !== "" && <span class="small muted wrap-anywhere">{each.variation}</span>}
          </li>
        ))}
      </ul>
    </section>
  );
}

/** What was run, when, and what disturbed it. */
function About({ series }: { series: Trials }) {
  const first = series.request.seed ?? 0;
  const given = Object.entries(series.request.arguments ?? {}).map(([name, value]) => `${name}: ${value}`);
  const disturbance = describeDisturbance(series);
  return (
    <div>
      {given.length > 0 && <p class="mono wrap-anywhere">{given.join(", ")}</p>}
      {disturbance !== "" && <p>Disturbed: {disturbance}.</p>}
      <p class="small muted">
        Begun {formatStart(series)}, seeds {first} to {first + series.wanted - 1}.
      </p>
    </div>
  );
}

function ReplayButton({ about, seed, label = "Replay" }: { about: Trials; seed: number; label?: string }) {
  const isBusy = replayed.value?.seed === seed;
  return (
    <button
      class="small"
      disabled={!may("operate") || replayed.value !== null}
      title={
        may("operate")
          ? "Run it again in simulation, and play it in all panels"
          : "This needs the role operate"
      }
      onClick={() => void playTrial(about, seed)}
    >
      {isBusy && <span class="spinner" />}
      {isBusy ? "It is run again" : label}
    </button>
  );
}

interface DistributionProps {
  about: Trials;
  spread: Spread;
  failed: ReadonlySet<number>;
}

const [WIDTH, DOT, EDGE, BASE] = [560, 7, 8, 64];

function Distribution({ about, spread, failed }: DistributionProps) {
  const { dots, bound, low, high } = dotsOf(spread);
  const x = (at: number): number => EDGE + at * (WIDTH - 2 * EDGE);
  const place = (value: number): number => (high === low ? 0.5 : (value - low) / (high - low));
  const worst = worstOf(spread);
  const format = (value: number): string => `${formatNumber(value, 4)} ${spread.unit}`.trim();
  const step = Math.min(DOT, (BASE - DOT) / Math.max(1, ...dots.map((each) => each.level)));
  return (
    <figure class="distribution">
      <figcaption class="row spread">
        <span>
          <strong>{spread.metric}</strong> <span class="muted">{spread.subject}</span>
        </span>
        <span class="small muted">
          median {format(spread.median)}
          {spread.bound !== null && `, wanted ${spread.target}`}
        </span>
      </figcaption>
      <svg
        viewBox={`0 0 ${WIDTH} ${BASE + 20}`}
        role="img"
        aria-label={`${spread.values.length} values of ${spread.metric} from ${format(spread.least)} to ${format(spread.greatest)}`}
      >
        <rect
          class="quartiles"
          x={x(place(spread.low_quartile))}
          y={2}
          width={Math.max(2, x(place(spread.high_quartile)) - x(place(spread.low_quartile)))}
          height={BASE - 2}
        />
        <path class="axis" d={`M${EDGE} ${BASE}H${WIDTH - EDGE}`} />
        <path class="median" d={`M${x(place(spread.median))} 2V${BASE}`} />
        {bound !== null && <path class="bound" d={`M${x(bound)} 2V${BASE}`} />}
        {dots.map((each) => (
          <circle
            key={each.seed}
            class={failed.has(each.seed) ? "dot is-bad" : each.seed === worst?.seed ? "dot is-worst" : "dot"}
            cx={x(each.at)}
            cy={BASE - DOT / 2 - each.level * step}
            r={DOT / 2 - 0.5}
            onClick={() => may("operate") && replayed.value === null && void playTrial(about, each.seed)}
          >
            <title>{`seed ${each.seed}: ${format(each.value)}; click to replay`}</title>
          </circle>
        ))}
        <text x={EDGE} y={BASE + 15}>
          {format(low)}
        </text>
        <text x={WIDTH - EDGE} y={BASE + 15} text-anchor="end">
          {high === low ? "" : format(high)}
        </text>
      </svg>
      {worst !== null && (
        <p class="row small">
          <span>
            Worst: {format(worst.value)}, seed {worst.seed}
          </span>
          <ReplayButton about={about} seed={worst.seed} label="Replay the worst" />
          {spread.median_missed !== null && <span class="is-bad">✗ {spread.median_missed}</span>}
        </p>
      )}
    </figure>
  );
}
