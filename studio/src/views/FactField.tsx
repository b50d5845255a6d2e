// The field for the value of a fact: what it is like depends on the type of the relation or property.
import type { StatableTerm } from "../api/types";
import { GoalInput } from "./GoalInput";

interface FactFieldProps {
  term: StatableTerm;
  /** The individuals that a relation may lead to. */
  things: readonly string[];
  /** The value in the syntax of the language; empty for none. */
  value: string;
  onChange: (value: string) => void;
}

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

export function FactField({ term, things, value, onChange }: FactFieldProps) {
  if (term.kind === "relation")
    return (
      <GoalInput label="Value" placeholder={term.type} value={value} onChange={onChange} words={things} />
    );
  if (term.type === "Bool") return <Choice options={["true", "false"]} value={value} onChange={onChange} />;
  if (term.values.length > 0) {
    const options = term.values.map((each) => JSON.stringify(each));
    return <Choice options={options} value={value} onChange={onChange} />;
  }
  if (term.type === "Text") return <TextField value={value} onChange={onChange} />;
  if (term.type.startsWith("Vector") || term.type === "Direction")
    return <VectorField unit={term.unit} value={value} onChange={onChange} />;
  return <NumberField unit={term.unit} value={value} onChange={onChange} />;
}

type TypedProps = Pick<FactFieldProps, "value" | "onChange">;

function Choice({ options, value, onChange }: TypedProps & { options: readonly string[] }) {
  return (
    <select
      aria-label="Value"
      class="mono"
      value={value}
      onChange={(event) => onChange(event.currentTarget.value)}
    >
      {!options.includes(value) && <option value={value}>{value}</option>}
      {options.map((each) => (
        <option key={each}>{each}</option>
      ))}
    </select>
  );
}

function TextField({ value, onChange }: TypedProps) {
  return (
    <input
      class="mono"
      aria-label="Value"
      placeholder="text"
      value={textOf(value)}
      onInput={(event) => onChange(JSON.stringify(event.currentTarget.value))}
    />
  );
}

function textOf(value: string): string {
  try {
    return String(JSON.parse(value));
  } catch {
    return value;
  }
}

/** A number; its unit stands beside it, and another one may be written. */
function NumberField({ unit, value, onChange }: TypedProps & { unit: string }) {
  const shown = unit !== "" && value.endsWith(` ${unit}`) ? value.slice(0, -unit.length - 1) : value;
  return (
    <span class="row">
      <input
        class="mono"
        aria-label="Value"
        inputMode="decimal"
        size={10}
        value={shown}
        onInput={(event) => onChange(withUnit(event.currentTarget.value, unit))}
      />
      {unit !== "" && (value === "" || shown !== value) && <span class="mono muted unit">{unit}</span>}
    </span>
  );
}

const withUnit = (text: string, unit: string): string =>
  unit !== "" && NUMBER.test(text.trim()) ? `${text.trim()} ${unit}` : text;

function VectorField({ unit, value, onChange }: TypedProps & { unit: string }) {
  const found = /^\((.*)\)/.exec(value)?.[1]?.split(",") ?? [];
  const parts = [0, 1, 2].map((index) => found[index]?.trim() ?? "");
  const change = (at: number, text: string): void => {
    const changed = parts.map((each, index) => (index === at ? text : each));
    onChange(`(${changed.join(", ")}) ${unit}`.trim());
  };
  return (
    <span class="row">
      {parts.map((each, index) => (
        <input
          key={index}
          class="mono"
          aria-label={`Value ${"xyz"[index]}`}
          inputMode="decimal"
          size={6}
          value={each}
          onInput={(event) => change(index, event.currentTarget.value)}
        />
      ))}
      {unit !== "" && <span class="mono muted unit">{unit}</span>}
    </span>
  );
}
