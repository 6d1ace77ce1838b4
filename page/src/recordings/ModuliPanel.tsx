// Young's moduli of the recording in focus: settings, run with progress, what came out, and the command for it.
import { Progress } from '../shell/Progress';
import { notify } from '../shell/notices';
import { useStore } from '../shell/store';
import { focus, gates, itemOf, items, moduliSettings, recordings, titleOf } from './model';
import { nameOf, recommendedFeature, recommendedName } from './features';
import { featuresOf, gateOptions, gatesWithoutOption } from './gates';
import { replacedTemperatures } from './origin';
import { endModuli, moduli, runModuli } from './moduli';
import { inShort, recommendedOf, type Recommended } from './recommended';
import { reports } from './reports';
import { SettingFields } from './SettingFields';
import { declared, fieldsOf, typing } from './settings';

/** What a typed temperature does to recordings that have one of their own. Said while it is typed: a press on a button ends
 * the typing, and the button must not move away under the pointer. */
function Replaced() {
  const taken = useStore(moduliSettings).temperature ?? '';
  const now = useStore(typing);
  const typed = now?.name === 'temperature' ? now.text : taken;
  const all = recordings(useStore(items)).filter((item) => item.state === 'ready');
  const sentence = replacedTemperatures(typed, all);
  return sentence === '' ? null : <p class="caution">{sentence}</p>;
}

/** The command that gives the same numbers; null before there is one. */
export function Command({ title, command }: { title: string; command: string }) {
  const active = useStore(gates);
  const options = gateOptions(active);
  const whole = options === '' ? command : `${command} ${options}`;
  const copy = () =>
    void navigator.clipboard.writeText(whole).then(
      () => notify('The command is in the clipboard.'),
      () => notify('The clipboard is not accessible; mark the command and copy it.', 'failed'),
    );
  return (
    <div class="command">
      <div class="row">
        <h3>{title}</h3>
        <button class="quiet" aria-label={`Copy: ${title}`} onClick={copy}>
          Copy
        </button>
      </div>
      <code tabIndex={0}>{whole}</code>
      {gatesWithoutOption(active).map((gate) => (
        <p key={gate.id} class="caution">
          The gate on {featuresOf(gate).map(nameOf).join(' and ')} is not part of the command, which computes these numbers itself.
        </p>
      ))}
    </div>
  );
}

function Run() {
  const number = useStore(focus);
  const runs = useStore(moduli);
  const all = recordings(useStore(items)).filter((item) => item.state === 'ready');
  const item = itemOf(number);
  if (number === null || !item) return null;
  const run = runs[number];
  if (run?.state === 'running')
    return <Progress label={`${Math.round(100 * run.done)} % of the events`} done={run.done} onStop={() => void endModuli(number)} />;
  return (
    <div class="row">
      <button class="primary" title={titleOf(item)} onClick={() => void runModuli([number])}>
        Compute moduli
      </button>
      {all.length > 1 && (
        <button aria-label={`Compute the moduli of all ${all.length} recordings`} onClick={() => void runModuli(all.map((item) => item.item))}>All {all.length}</button>
      )}
    </div>
  );
}

/** Of the events within the gates: the number to report, or why there is none; why this one stands with all that the moduli rest on. */
function ToReport({ of }: { of: Recommended | undefined }) {
  const short = of ? inShort(of) : '…';
  const kind = of && recommendedFeature(of.by);
  return (
    <div class="to-report">
      <h3>
        {recommendedName}: {short === 'none' ? short : `${short} kPa`}
      </h3>
      {kind && <p class="soft">{nameOf(kind)}</p>}
      {of && !Number.isFinite(of.value) && <p class="soft">{of.text}</p>}
    </div>
  );
}

export function ModuliPanel() {
  const number = useStore(focus);
  const run = useStore(moduli)[number ?? -1];
  useStore(items);
  const report = useStore(reports)[number ?? -1];
  const recommended = recommendedOf(report);
  const fields = fieldsOf(useStore(declared));
  return (
    <section class="moduli" aria-label="Moduli">
      <h2>Young's moduli</h2>
      {run?.state === 'ready' && <ToReport of={recommended} />}
      <SettingFields of={fields.filter((setting) => setting.usual)} />
      <Replaced />
      <Run />
      <details>
        <summary>More settings</summary>
        <SettingFields of={fields.filter((setting) => !setting.usual)} />
      </details>
      {run?.state === 'failed' && run.error && <p class="alarm">{run.error}</p>}
      {report?.state === 'ready' && report.lines && report.lines.length > 0 && (
        <details>
          <summary>What the moduli rest on</summary>
          <ul class="remarks">
            {report.lines.map((line) => (
              <li key={line}>{line}</li>
            ))}
          </ul>
        </details>
      )}
      {run?.command && <Command title="As a command" command={run.command} />}
      {run?.command_several && <Command title="With cortex" command={run.command_several} />}
    </section>
  );
}
