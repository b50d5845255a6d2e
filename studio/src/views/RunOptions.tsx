// How something is started: a field for each that a cell takes, as the API describes it.
import { RUN_FORM, type RunField } from "../api/run_form";

export type RunChoice = Readonly<Record<string, boolean | number>>;

interface RunOptionsProps {
  value: RunChoice;
  onChange: (value: RunChoice) => void;
}

export function RunOptions({ value, onChange }: RunOptionsProps) {
  const change = (name: string, given: boolean | number): void => {
    const rest = Object.entries(value).filter(([each]) => each !== name);
    const isSet = given !== false && !Number.isNaN(given);
    onChange(Object.fromEntries(isSet ? [...rest, [name, given]] : rest));
  };
  const show = (each: RunField) => (
    <Field key={each.name} field={each} value={value[each.name]} onChange={change} />
  );
  return (
    <div class="stack options">
      {RUN_FORM.filter((each) => each.kind === "flag").map(show)}
      <details class="small">
        <summary>Limits and priority</summary>
        <div class="stack">{RUN_FORM.filter((each) => each.kind === "number").map(show)}</div>
      </details>
    </div>
  );
}

interface FieldProps {
  field: RunField;
  value: boolean | number | undefined;
  onChange: (name: string, value: boolean | number) => void;
}

function Field({ field, value, onChange }: FieldProps) {
  const text = field.text.replace(/\.$/, "");
  if (field.kind === "flag")
    return (
      <label class="row small">
        <input
          type="checkbox"
          checked={value === true}
          onChange={(event) => onChange(field.name, event.currentTarget.checked)}
        />
        {text}
      </label>
    );
  return (
    <label class="stack small">
      {text}
      <input
        type="number"
        step="any"
        value={typeof value === "number" ? value : ""}
        onChange={(event) => onChange(field.name, event.currentTarget.valueAsNumber)}
      />
    </label>
  );
}
