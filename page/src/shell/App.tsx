// The frame of the page: name, workspaces, theme.
import { CellTools } from '../cell/CellTools';
import { CellWorkspace } from '../cell/CellWorkspace';
import { RecordingsWorkspace } from '../recordings/RecordingsWorkspace';
import { Notices } from './notices';
import { goTo, place, type Workspace } from './place';
import { useStore } from './store';
import { themeChoice, type ThemeChoice } from './theme';

const workspaces: [Workspace, string][] = [
  ['cell', 'Cell'],
  ['recordings', 'Recordings'],
];
const themes: [ThemeChoice, string][] = [
  ['system', 'As the system'],
  ['light', 'Light'],
  ['dark', 'Dark'],
];

// Each workspace keeps its own part of the address while the other one is shown.
const queries = new Map<Workspace, URLSearchParams>();

function open(workspace: Workspace): void {
  const now = place.get();
  if (now.workspace === workspace) return;
  queries.set(now.workspace, now.query);
  goTo({ workspace, query: queries.get(workspace) ?? new URLSearchParams() });
}

function ThemeSelect() {
  const choice = useStore(themeChoice);
  return (
    <label class="theme">
      <span class="hidden">Theme</span>
      <select value={choice} onChange={(event) => themeChoice.set(event.currentTarget.value as ThemeChoice)}>
        {themes.map(([value, name]) => (
          <option key={value} value={value}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}

export function App() {
  const { workspace } = useStore(place);
  return (
    <>
      <a class="skip" href="#main" onClick={(event) => (event.preventDefault(), document.getElementById('main')?.focus())}>
        Skip to the workspace
      </a>
      <header class="bar">
        <h1>rheocyte</h1>
        <nav aria-label="Workspaces">
          {workspaces.map(([name, title]) => (
            <button key={name} aria-current={name === workspace ? 'page' : undefined} onClick={() => open(name)}>
              {title}
            </button>
          ))}
        </nav>
        <div class="bar-place">{workspace === 'cell' && <CellTools />}</div>
        <ThemeSelect />
      </header>
      <main id="main" tabIndex={-1}>
        {workspace === 'cell' ? <CellWorkspace /> : <RecordingsWorkspace />}
      </main>
      <Notices />
    </>
  );
}
