// A view that needs the whole page, in the place of the panels; Escape brings them back.
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { Icon } from "./icons";

interface FullPageProps {
  title: string;
  /** What the view adds to the right of its title. */
  tools?: ComponentChildren;
  onClose: () => void;
  children: ComponentChildren;
}

export function FullPage({ title, tools, onClose, children }: FullPageProps) {
  const page = useRef<HTMLElement>(null);
  useEffect(() => {
    page.current?.focus({ preventScroll: true });
    const close = (event: KeyboardEvent): void => {
      if (event.key !== "Escape" || event.defaultPrevented || document.querySelector("dialog[open]")) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      onClose();
    };
    document.addEventListener("keydown", close, true);
    return () => document.removeEventListener("keydown", close, true);
  }, []);
  return (
    <main class="full-page" aria-label={title} ref={page} tabIndex={-1}>
      <header class="panel-head full-page-head">
        <h2>{title}</h2>
        <div class="grow" />
        {tools}
        <button onClick={onClose} title="Back to the panels (Esc)">
          <Icon name="cross" />
          Close
        </button>
      </header>
      {children}
    </main>
  );
}
