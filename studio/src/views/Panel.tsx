// A panel of the workspace: a heading or tabs, what the view adds to it, and a button to make it large.
import type { ComponentChildren } from "preact";
import { maximised, toggleMaximised, type PanelName } from "./layout";
import { Icon } from "./icons";

interface PanelProps {
  name: PanelName;
  title: string;
  /** What the view adds to the right of its heading. */
  tools?: ComponentChildren;
  children: ComponentChildren;
}

export function Panel({ name, title, tools, children }: PanelProps) {
  return (
    <section class="panel" data-panel={name} aria-label={title} tabIndex={-1}>
      <header class="panel-head">
        <h2>{title}</h2>
        <div class="grow" />
        {tools}
        <MaximiseButton name={name} title={title} />
      </header>
      <div class="panel-body">{children}</div>
    </section>
  );
}

export interface Tab {
  id: string;
  title: string;
  count?: number | undefined;
  view: () => ComponentChildren;
}

interface TabbedPanelProps {
  name: PanelName;
  title: string;
  tabs: readonly Tab[];
  active: string;
  onChoose: (id: string) => void;
  tools?: ComponentChildren;
}

/** A panel with several views, one of which is shown. */
export function TabbedPanel({ name, title, tabs, active, onChoose, tools }: TabbedPanelProps) {
  const shown = tabs.find((each) => each.id === active) ?? tabs[0];
  const move = (event: KeyboardEvent): void => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    const at = tabs.findIndex((each) => each.id === active);
    const next = tabs[(at + step + tabs.length) % tabs.length];
    if (step === 0 || next === undefined) return;
    onChoose(next.id);
    document.getElementById(`tab-${next.id}`)?.focus();
  };
  return (
    <section class="panel" data-panel={name} aria-label={title} tabIndex={-1}>
      <header class="panel-head">
        <h2 class="visually-hidden">{title}</h2>
        <div class="tabs" role="tablist" aria-label={title} onKeyDown={move}>
          {tabs.map((each) => (
            <button
              key={each.id}
              id={`tab-${each.id}`}
              role="tab"
              class="tab"
              aria-selected={each.id === active}
              aria-controls={`panel-${name}`}
              tabIndex={each.id === active ? 0 : -1}
              onClick={() => onChoose(each.id)}
            >
              {each.title}
              {each.count !== undefined && <span class="tab-count">{each.count}</span>}
            </button>
          ))}
        </div>
        <div class="grow" />
        {tools}
        <MaximiseButton name={name} title={title} />
      </header>
      <div class="panel-body" role="tabpanel" id={`panel-${name}`} aria-labelledby={`tab-${active}`}>
        {shown?.view()}
      </div>
    </section>
  );
}

function MaximiseButton({ name, title }: { name: PanelName; title: string }) {
  const isLarge = maximised.value === name;
  const label = isLarge ? `Show all panels again` : `Enlarge ${title}`;
  return (
    <button
      class="plain icon"
      title={`${label} (m)`}
      aria-label={label}
      onClick={() => toggleMaximised(name)}
    >
      <Icon name={isLarge ? "shrink" : "expand"} />
    </button>
  );
}
