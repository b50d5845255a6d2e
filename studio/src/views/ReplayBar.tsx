// The controls of a recording that is played.
import { endReplay, play, seek, setSpeed } from "../state/replay";
import { replay } from "../state/studio";
import { formatTime } from "../state/text";
import { Icon } from "./icons";

const SPEEDS = [0.25, 0.5, 1, 2, 4, 10, 50];

export function ReplayBar() {
  const current = replay.value;
  if (current === null) return null;
  return (
    <div class="replay-bar row" role="toolbar" aria-label="Replay">
      <button
        class="icon"
        aria-label={current.playing ? "Hold" : "Play"}
        onClick={() => play(!current.playing)}
      >
        <Icon name={current.playing ? "pause" : "play"} />
      </button>
      <input
        type="range"
        aria-label="Time"
        min={current.begin}
        max={current.end}
        step="any"
        value={current.time}
        onInput={(event) => seek(Number(event.currentTarget.value))}
      />
      <span class="mono replay-time">
        {formatTime(current.time)} of {formatTime(current.end)}
      </span>
      <label>
        <span class="visually-hidden">Speed</span>
        <select value={current.speed} onChange={(event) => setSpeed(Number(event.currentTarget.value))}>
          {SPEEDS.map((each) => (
            <option key={each} value={each}>
              {each} ×
            </option>
          ))}
        </select>
      </label>
      <button onClick={endReplay}>Back to the cell</button>
    </div>
  );
}
