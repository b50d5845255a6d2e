// A recording that is dropped anywhere on the page is played; while it is held over the page, the page says so.
import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { attempt } from "../state/actions";
import { comparison } from "../state/comparison";
import { openRecording } from "../state/replay";
import { runTab } from "./layout";

/** Play a file in the panels. */
export async function openFile(file: File): Promise<void> {
  await attempt(async () => openRecording(file.name, await file.arrayBuffer()));
  comparison.value = null;
  runTab.value = "run";
}

const hasFile = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;

/** The page, onto which a file can be dropped. */
export function Dropping({ children }: { children: ComponentChildren }) {
  const [isOver, setIsOver] = useState(false);
  return (
    <div
      class="page"
      onDragOver={(event) => {
        if (!hasFile(event)) return;
        event.preventDefault();
        setIsOver(true);
      }}
      onDragLeave={(event) => {
        if (event.relatedTarget === null) setIsOver(false);
      }}
      onDrop={(event) => {
        const file = event.dataTransfer?.files[0];
        if (!hasFile(event)) return;
        event.preventDefault();
        setIsOver(false);
        if (file !== undefined) void openFile(file);
      }}
    >
      {children}
      {isOver && (
        <div class="drop-hint" role="status">
          <p>Drop the recording (.mcap) to play it</p>
        </div>
      )}
    </div>
  );
}
