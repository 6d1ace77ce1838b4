// One event: its image with outline and model, its features, its modulus or the reason why there is none.
import type { ComponentChildren } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { readEvent, type CombinedCell, type EventDetail } from '../api';
import { significant, withErrors } from '../draw/numbers';
import { openInCell } from '../shell/open_in_cell';
import { Progress, useLasting } from '../shell/Progress';
import { useStore } from '../shell/store';
import { TypedInput } from '../shell/TypedInput';
import { nameOf, recommendedFeature, unitOf, youngModulus } from './features';
import { EventImage } from './EventImage';
import { choice, focus, itemOf, items, readRecordings, titleOf, type Choice } from './model';
import { moduliVersion } from './moduli';
import { recommendedOf } from './recommended';
import { reports } from './reports';
import { ResidualPlot } from './ResidualPlot';
import { counted } from './scale';

/** An event and what the program says of it. */
interface Inspected {
  of: Choice;
  detail: EventDetail;
}

interface Found {
  inspected: Inspected | null;
  error: string;
  stop: () => void;
  running: boolean;
}

/** The event's details; those of the one before in the same recording stay until they have come. */
function useDetail(chosen: Choice | null): Found {
  const [inspected, setInspected] = useState<Inspected | null>(null);
  const [error, setError] = useState('');
  const [stop, setStop] = useState<AbortController | null>(null);
  const version = useStore(moduliVersion);
  useEffect(() => {
    setError('');
    if (!chosen) return setInspected(null);
    const control = new AbortController();
    setStop(control);
    readEvent(chosen.item, chosen.event, control.signal)
      .then((detail) => {
        // Of another file than the list knows: it is read again, and the choice falls.
        if (detail.version !== itemOf(chosen.item)?.version) return readRecordings();
        setInspected({ of: chosen, detail });
      })
      .catch((failure: Error & { reason?: string }) => {
        setInspected(null);
        if (failure.reason !== 'stopped') setError(failure.message);
      })
      .finally(() => setStop((now) => (now === control ? null : now)));
    return () => control.abort();
  }, [chosen?.item, chosen?.event, version]);
  const shown = inspected?.of.item === chosen?.item ? inspected : null;
  return { inspected: shown, error, stop: () => stop?.abort(), running: stop !== null };
}

function Value({ value, error, name = 'E' }: { value: number; error: number | null | undefined; name?: ComponentChildren }) {
  return (
    <span class="value">
      {name !== '' && <span class="symbol">{name} </span>}
      {withErrors(value, [error ?? null])} <span class="unit">kPa</span>
    </span>
  );
}

const noneBecause = (reason: string) => (reason === '' ? ': none' : `: none, ${reason}`);

/** The modulus that is recommended for the recording first, and E from deformation. */
function Headline({ detail, by }: { detail: EventDetail; by: string }) {
  const deformation = detail.young_modulus_kPa;
  const ofDeformation = { name: nameOf(youngModulus), value: deformation, error: detail.young_modulus_kPa_error, none: detail.state };
  const effective = detail.features.effective_modulus_kPa;
  const found = {
    deformation: ofDeformation,
    elongated: {
      name: nameOf(recommendedFeature('elongated')!),
      value: detail.young_modulus_asymmetry_kPa ?? detail.young_modulus_inertia_kPa ?? null,
      error: detail.young_modulus_asymmetry_kPa_error ?? detail.young_modulus_inertia_kPa_error,
      none: '',
    },
    effective: {
      name: nameOf(recommendedFeature('effective')!),
      value: typeof effective === 'number' ? effective : null,
      error: null,
      symbol: <>E<sub>eff</sub></>,
      none: 'the cell lies outside the table',
    },
  }[by];
  const first = found ?? ofDeformation;
  return (
    <>
      {by === 'none' ? (
        <p class="large none">No modulus is recommended for the recording</p>
      ) : (
        <>
          <p class={first.value === null ? 'large none' : 'large'}>
            {first.value === null ? 'No modulus' : <Value value={first.value} error={first.error} name={'symbol' in first ? first.symbol : 'E'} />}
          </p>
          <p class="soft">
            {first.name}
            {first.value === null ? noneBecause(first.none) : found && ', recommended for the recording'}
          </p>
        </>
      )}
      {(first !== ofDeformation || by === 'none') && (
        <p class="soft from-deformation">
          {ofDeformation.name}
          {deformation === null ? noneBecause(detail.state) : <>: <Value value={deformation} error={ofDeformation.error} name="" /></>}
        </p>
      )}
    </>
  );
}

function Modulus({ detail, item }: { detail: EventDetail; item: number }) {
  const value = detail.young_modulus_kPa;
  const recommended = recommendedOf(useStore(reports)[item]);
  return (
    <div class="modulus">
      <Headline detail={detail} by={recommended?.by ?? ''} />
      {detail.sentence && (
        <p class="soft">
          {value !== null && detail.state !== 'valid' && <strong>{detail.state}: </strong>}
          {detail.sentence}
        </p>
      )}
    </div>
  );
}

/** The cell with bulk and cortex that a combined table among the items has for this event. */
function Cortex({ cell }: { cell: CombinedCell }) {
  return (
    <div class="cortex-cell">
      <h3>
        <svg class="sample" viewBox="0 0 20 8" aria-hidden="true">
          <path class="model-cortex" d="M0 4H20" />
        </svg>
        With cortex ({cell.table})
      </h3>
      <p class="soft">{cell.sentence.replaceAll('+-', '±')}</p>
      {cell.case && (
        <button onClick={() => openInCell(cell.case!)}>Open in Cell with cortex</button>
      )}
    </div>
  );
}

function Extras({ detail }: { detail: EventDetail }) {
  const features = Object.entries(detail.features).filter(
    (row): row is [string, number] => row[0] !== 'state' && typeof row[1] === 'number' && Number.isFinite(row[1]),
  );
  return (
    <table class="event-features">
      <caption class="hidden">Features of the event</caption>
      <tbody>
        {features.map(([feature, value]) => (
          <tr key={feature} title={feature}>
            <th scope="row">{nameOf(feature)}</th>
            <td>{Number.isInteger(value) ? counted(value) : significant(value, 5)}</td>
            <td class="unit">{unitOf(feature)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Steps({ chosen }: { chosen: Choice }) {
  const count = itemOf(chosen.item)?.events ?? 0;
  const go = (event: number) => choice.set({ ...chosen, event: Math.min(count - 1, Math.max(0, event)) });
  return (
    <div class="row steps">
      <button aria-label="Previous event" disabled={chosen.event === 0} onClick={() => go(chosen.event - 1)}>
        ‹
      </button>
      <label>
        <span class="hidden">Number of the event</span>
        <TypedInput
          class="number"
          type="number"
          min={1}
          max={count}
          value={chosen.event + 1}
          take={(text) => text && go(Math.round(Number(text)) - 1)}
        />
      </label>
      <span class="soft">of {counted(count)}</span>
      <button aria-label="Next event" disabled={chosen.event + 1 >= count} onClick={() => go(chosen.event + 1)}>
        ›
      </button>
    </div>
  );
}

function Detail({ of, detail }: Inspected) {
  return (
    <>
      <EventImage key={`${of.item}/${of.event}`} chosen={of} detail={detail} />
      <Modulus detail={detail} item={of.item} />
      {detail.outline && detail.model && <ResidualPlot outline={detail.outline} model={detail.model} pixel={detail.pixel_um ?? 0} />}
      {detail.case && (
        <button class="primary" onClick={() => openInCell(detail.case!)}>
          Open in Cell
        </button>
      )}
      {detail.combined && <Cortex cell={detail.combined} />}
      <Extras detail={detail} />
    </>
  );
}

/** Recording and tables are read before the first event is chosen: that takes longer than all that follows. */
function useReadiness(): void {
  useStore(items);
  const number = useStore(focus);
  const version = useStore(moduliVersion);
  const item = itemOf(number);
  const ready = item?.state === 'ready' && (item.events ?? 0) > 0;
  useEffect(() => {
    if (ready) void readEvent(number!, 0).catch(() => undefined);
  }, [number, ready, version]);
}

export function Inspector() {
  useReadiness();
  const chosen = useStore(choice);
  const { inspected, error, stop, running } = useDetail(chosen);
  const lasting = useLasting(running);
  const item = chosen ? itemOf(chosen.item) : undefined;
  return (
    <section class="inspector" aria-label="Event">
      <h2>Event</h2>
      {!chosen && <p class="soft">Choose an event in a plot: its image appears here, with the contour of the model's cell.</p>}
      {chosen && item && (
        <>
          <p class="soft">{titleOf(item)}</p>
          <Steps chosen={chosen} />
        </>
      )}
      {lasting && <Progress label="The model's cell" onStop={stop} />}
      {error && <p class="alarm">{error}</p>}
      {inspected && <Detail {...inspected} />}
    </section>
  );
}
