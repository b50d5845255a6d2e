// Logging in with a token that a person pastes, and why the code in the address has not done it.
import { useState } from "preact/hooks";
import { api, ApiError } from "../api/client";
import { session } from "../state/studio";
import { codeProblem } from "./arriving";

export function Login() {
  const [token, setToken] = useState("");
  const [problem, setProblem] = useState("");
  const unused = codeProblem.value;
  const submit = async (event: Event): Promise<void> => {
    event.preventDefault();
    try {
      await api.logIn(token.trim());
      session.value = await api.session();
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      setProblem(error.status === 401 ? "This token is not valid, or was revoked." : error.message);
    }
  };
  return (
    <main class="login">
      <form class="stack" onSubmit={(event) => void submit(event)}>
        <h1>skillc studio</h1>
        {unused !== "" && (
          <p class="notice bad" role="alert">
            {unused}
          </p>
        )}
        <p>
          Run <code>skillc studio</code>
          {unused !== "" && " again"} in the folder of the server: it opens this page with a code that is good
          once, for a minute. Or paste a token:
        </p>
        <label class="stack">
          <span class="small muted">Token</span>
          <input
            class="mono"
            type="password"
            autocomplete="off"
            value={token}
            aria-invalid={problem !== ""}
            aria-describedby="login-problem"
            onInput={(event) => setToken(event.currentTarget.value)}
          />
        </label>
        <p id="login-problem" class={problem === "" ? "" : "notice bad"} role="alert">
          {problem}
        </p>
        <button class="primary" disabled={token.trim() === ""}>
          Log in
        </button>
        <p class="small muted">
          The token of the command line is in <code>admin.token</code> of the state folder;{" "}
          <code>skillc token add</code> makes others.
        </p>
      </form>
    </main>
  );
}
