// A file that somebody else has changed meanwhile: theirs and yours side by side; nothing is overwritten before it was seen.
import { useEffect, useRef } from "preact/hooks";
import type { MergeView } from "@codemirror/merge";
import { keepMine, leaveConflict, revertFile, type Conflict } from "../state/source";
import { FullPage } from "./FullPage";

export function ConflictPage({ conflict }: { conflict: Conflict }) {
  const box = useRef<HTMLDivElement>(null);
  const merge = useRef<MergeView | null>(null);
  useEffect(() => {
    let isOver = false;
    void import("../editor/merging").then(({ openMerge }) => {
      if (isOver || box.current === null) return;
      merge.current = openMerge(box.current, conflict);
    });
    return () => {
      isOver = true;
      merge.current?.destroy();
    };
  }, [conflict]);
  const mine = (): string => merge.current?.b.state.doc.toString() ?? conflict.mine;
  return (
    <FullPage
      title={`${conflict.path} has changed on disk`}
      onClose={leaveConflict}
      tools={
        <>
          <button title="Your text is dropped" onClick={() => void revertFile()}>
            Take theirs
          </button>
          <button
            class="primary"
            title="It replaces the file on disk as it is shown here"
            onClick={() => void keepMine(mine())}
          >
            Save mine
          </button>
        </>
      }
    >
      <div class="conflict">
        <div class="conflict-heads row">
          <h3 class="grow">On disk now</h3>
          <h3 class="grow">Yours; change it here</h3>
        </div>
        <div class="conflict-texts" ref={box} />
      </div>
    </FullPage>
  );
}
