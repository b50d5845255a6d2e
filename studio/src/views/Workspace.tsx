// The page once somebody is logged in: the bar on top and five panels.
import { computed } from "@preact/signals";
import { comparison } from "../state/comparison";
import { conflict } from "../state/source";
import { operation } from "../state/studio";
import { shownSeries } from "../state/trials";
import { CellStrip } from "./CellStrip";
import { ConflictPage } from "./ConflictPage";
import { ComparisonPage } from "./ComparisonPage";
import { Details } from "./Details";
import { Dropping } from "./Dropping";
import { EventsView } from "./EventsView";
import { Help } from "./Help";
import { detailsTab, maximised, runTab, sizes } from "./layout";
import { Messages } from "./Messages";
import { Panel, TabbedPanel } from "./Panel";
import { ReplayBar } from "./ReplayBar";
import { RunPanel } from "./RunPanel";
import { RunsView } from "./RunsView";
import { SceneView } from "./SceneView";
import { SignalsView } from "./SignalsView";
import { SourceView } from "./SourceView";
import { Splitter } from "./Splitter";
import { JobsView } from "./JobsView";
import { TrialsPage } from "./TrialsPage";
import { TopBar } from "./TopBar";
import { TreePanel } from "./TreeView";
import { WorldView } from "./WorldView";

/** Whether a view has the place of the panels. */
const isCovered = computed(
  () => comparison.value !== null || shownSeries.value !== null || conflict.value !== null,
);

function CoveringPage() {
  if (conflict.value !== null) return <ConflictPage conflict={conflict.value} />;
  if (comparison.value !== null) return <ComparisonPage shown={comparison.value} />;
  return shownSeries.value === null ? null : <TrialsPage series={shownSeries.value} />;
}

export function Workspace() {
  const { left, middle, upper, scene } = sizes.value;
  const style = {
    "--left": `${left}px`,
    "--middle": `${middle}fr`,
    "--right": `${1 - middle}fr`,
    "--upper": `${upper}fr`,
    "--lower": `${1 - upper}fr`,
    "--scene": `${scene}fr`,
    "--signals": `${1 - scene}fr`,
  };
  return (
    <Dropping>
      <div>
        <TopBar />
        <CellStrip />
        <ReplayBar />
      </div>
      <CoveringPage />
      <main
        class="workspace"
        style={style}
        hidden={isCovered.value}
        data-maximised={maximised.value ?? undefined}
      >
        <RunColumn />
        <Splitter of="left" label="Width of the run panel" vertical min={240} max={480} perPixel={() => 1} />
        <div class="column column-middle">
          <TreePanel />
          <Splitter
            of="upper"
            label="Height of the tree"
            vertical={false}
            min={0.2}
            max={0.8}
            perPixel={(both) => 1 / both}
          />
          <DetailsPanel />
        </div>
        <Splitter
          of="middle"
          label="Width of the tree"
          vertical
          min={0.3}
          max={0.7}
          perPixel={(both) => 1 / both}
        />
        <div class="column column-right">
          <Panel name="scene" title="3-D">
            <SceneView />
          </Panel>
          <Splitter
            of="scene"
            label="Height of the 3-D view"
            vertical={false}
            min={0.2}
            max={0.8}
            perPixel={(both) => 1 / both}
          />
          <SignalsView />
        </div>
      </main>
      <Messages />
      <Help />
    </Dropping>
  );
}

function RunColumn() {
  return (
    <div class="column column-left">
      <TabbedPanel
        name="run"
        title="Run"
        active={runTab.value}
        onChoose={(id) => (runTab.value = id as typeof runTab.value)}
        tabs={[
          { id: "run", title: "Run", view: () => <RunPanel /> },
          { id: "runs", title: "Runs", view: () => <RunsView /> },
          { id: "jobs", title: "Jobs", view: () => <JobsView /> },
        ]}
      />
    </div>
  );
}

function DetailsPanel() {
  return (
    <TabbedPanel
      name="details"
      title="Details"
      active={detailsTab.value}
      onChoose={(id) => (detailsTab.value = id as typeof detailsTab.value)}
      tabs={[
        { id: "why", title: "Why", view: () => <Details /> },
        { id: "world", title: "World", view: () => <WorldView /> },
        { id: "source", title: "Source", view: () => <SourceView /> },
        { id: "events", title: "Events", count: operation.value.log.length, view: () => <EventsView /> },
      ]}
    />
  );
}
