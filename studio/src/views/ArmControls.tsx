// The real arms of a cell in the strip: who has control, and how regular their control periods are.
import type { ControlReport } from "../api/types";
import { describeRate, describeSlider, formatMilliseconds, realArms } from "../state/real_arms";
import { connection } from "../state/studio";
import { Icon } from "./icons";
import { Popover } from "./Popover";
import { lookOfControl } from "./status";

export function ArmControls() {
  return (
    <>
      {realArms.value.map((each) => (
        <ArmControl key={each.name} report={each} />
      ))}
    </>
  );
}

function ArmControl({ report }: { report: ControlReport }) {
  const isKnown = connection.value.state === "open";
  const [tone, icon, word] = lookOfControl(report.state, isKnown);
  const [slider, rate] = isKnown ? [describeSlider(report), describeRate(report)] : ["", ""];
  const isAlone = realArms.value.length === 1;
  return (
    <Popover
      label={[word, report.name, slider, rate].filter((each) => each !== "").join(" ")}
      name={`How ${report.name} is controlled`}
      title={report.sentence || `How ${report.name} is controlled, and how regularly`}
      isRight
      face={
        <>
          <span class={`badge ${tone}`}>
            <Icon name={icon} />
            {word}
          </span>{" "}
          <strong>{report.name}</strong> <span class="small mono arm-slider">{slider}</span>{" "}
          <span class={`small mono arm-rate ${isAlone ? "" : "is-crowded"}`}>{rate}</span>
        </>
      }
    >
      {() => <Report report={report} word={word} />}
    </Popover>
  );
}

function Report({ report, word }: { report: ControlReport; word: string }) {
  const { rate_hz: rate, late_s: late, sentence } = report;
  return (
    <>
      <p>
        <strong>{report.name}</strong>
      </p>
      {sentence !== "" && <p class="notice bad">{sentence}</p>}
      <dl class="arm-report">
        <dt>Device</dt>
        <dd>{word}</dd>
        <dt>Control periods</dt>
        <dd class="mono">
          {rate === null ? "none" : `${rate.toFixed(0)} of ${(1 / report.period_s).toFixed(0)} a second`}
        </dd>
        <dt title="By how much the latest period of the last seconds began after it was due">Latest begin</dt>
        <dd class="mono">{late === null ? "not known" : `${formatMilliseconds(late)} late`}</dd>
        <dt title="Periods without a command or a state since the arm was connected">Lost periods</dt>
        <dd class="mono">{report.lost_periods}</dd>
        <dt>Speed slider</dt>
        <dd class="mono">{(report.speed_share * 100).toFixed(0)} %</dd>
        <dt>Priority</dt>
        <dd>
          {report.real_time
            ? "before all other processes"
            : "the usual one: other processes can delay the arm"}
        </dd>
      </dl>
    </>
  );
}
