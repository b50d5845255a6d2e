// The page of skillc studio.
import { render } from "preact";
import { useLayoutEffect } from "preact/hooks";
import "uplot/dist/uPlot.min.css";
import "./design/tokens.css";
import "./design/base.css";
import "./design/layout.css";
import "./design/views.css";
import "./design/pages.css";
import { LOGGED_OUT } from "./api/client";
import { followBounds } from "./state/bounds";
import { followLease } from "./state/lease";
import { followServer } from "./state/live";
import { measureSamples } from "./state/signals";
import { operation, planned, session, told } from "./state/studio";
import { arrive, followAsked } from "./views/arriving";
import { handleKey, handleStop } from "./views/keys";
import { Login } from "./views/Login";
import { Workspace } from "./views/Workspace";

function App() {
  const who = session.value;
  if (who === undefined)
    return (
      <main class="empty">
        <span class="spinner" />
        skillc studio
      </main>
    );
  return who === null ? <Login /> : <LoggedIn />;
}

function LoggedIn() {
  useLayoutEffect(() => {
    const ends = [measureSamples(), followServer(), followLease(), followBounds(), followAsked()];
    window.addEventListener("keydown", handleStop, true);
    document.addEventListener("keydown", handleKey);
    return () => {
      window.removeEventListener("keydown", handleStop, true);
      document.removeEventListener("keydown", handleKey);
      ends.forEach((end) => end());
    };
  }, []);
  return <Workspace />;
}

// What is shown, for tests and the console of the browser.
Object.assign(window, { skillcStudio: { told, operation, planned } });

const root = document.getElementById("app");
if (root !== null) render(<App />, root);
window.addEventListener(LOGGED_OUT, () => (session.value = null));
window.addEventListener("hashchange", () => void arrive());
void arrive();
