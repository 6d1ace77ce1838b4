// The frame of the page: name, workplaces, theme.
import { CellTools } from '../cell/CellTools';
import { CellWorkplace } from '../cell/CellWorkplace';
import { RecordingsWorkplace } from '../recordings/RecordingsWorkplace';
import { Notices } from './notices';
import { goTo, place, type Workplace } from './place';
import { useStore } from './store';
import { themeChoice, type ThemeChoice } from './theme';

const workplaces: [Workplace, string][] = [
  ['cell', 'Cell'],
  ['recordings', 'Recordings'],
];
const themes: [ThemeChoice, string][] = [
  ['system', 'As the system'],
  ['light', 'Light'],
  ['dark', 'Dark'],
];

// Each workplace keeps its own part of the address while the other one is shown.
const queries = new Map<Workplace, URLSearchParams>();

function open(workplace: Workplace): void {
  const now = place.get();
  if (now.workplace === workplace) return;
  queries.set(now.workplace, now.query);
  goTo({ workplace, query: queries.get(workplace) ?? new URLSearchParams() });
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
  const { workplace } = useStore(place);
  return (
    <>
      <a class="skip" href="#main" onClick={(event) => (event.preventDefault(), document.getElementById('main')?.focus())}>
        Skip to the workplace
      </a>
      <header class="bar">
        <h1>rheocyte</h1>
        <nav aria-label="Workplaces">
          {workplaces.map(([name, title]) => (
            <button key={name} aria-current={name === workplace ? 'page' : undefined} onClick={() => open(name)}>
              {title}
            </button>
          ))}
        </nav>
        <div class="bar-place">{workplace === 'cell' && <CellTools />}</div>
        <ThemeSelect />
      </header>
      <main id="main" tabIndex={-1}>
        {workplace === 'cell' ? <CellWorkplace /> : <RecordingsWorkplace />}
      </main>
      <Notices />
    </>
  );
}
