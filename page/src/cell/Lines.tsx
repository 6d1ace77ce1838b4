// The lines of the picture, as SVG: walls, streamlines, undeformed circle, contour, hull, tension, scale bar.
// Colours stand in attributes, not in the style sheet, so that an exported picture keeps them.
import { cloneElement } from 'preact';
import { useMemo } from 'preact/hooks';
import type { Fields } from '../draw/fields';
import type { Outline } from '../api';
import { cellMap, liquidMap, shade, tensionMap } from '../draw/colormap';
import { streamlines } from '../draw/streamlines';
import { token } from '../shell/theme';
import type { Scene } from './scene';
import { pathOf, scaleBar_um, wallPath, wholeOutline, xOf, yOf, type Stage } from './frame';
import type { Looks } from './looks';

interface LinesProps {
  stage: Stage;
  scene: Scene;
  looks: Looks;
  theme: 'light' | 'dark';
  mark: { x_um: number; r_um: number } | null;
}

/** Colours of the lines over the maps, which are light where little happens in both themes. */
const overMap = '#14202b';

function Walls({ stage, scene }: { stage: Stage; scene: Scene }) {
  const wall = scene.wall ?? scene.fields?.wall;
  return (
    <g fill={token('--wall')} stroke={token('--ink')} stroke-width={1.5}>
      <path d={wallPath(stage, wall, 1)} />
      <path d={wallPath(stage, wall, -1)} />
    </g>
  );
}

/** Where the fields are of the upper half alone, the lower one is that, mirrored at the axis. */
const mirrored = (stage: Stage) => `matrix(1 0 0 -1 0 ${2 * stage.axis})`;

function Stream({ stage, fields, radius_um }: { stage: Stage; fields: Fields; radius_um: number }) {
  const found = useMemo(() => streamlines(fields, ...stage.whole_um, radius_um), [fields, ...stage.whole_um, radius_um]);
  const paths = found.map(({ points }) => pathOf(stage, { x_um: points.map(([x]) => x), r_um: points.map(([, r]) => r) }, false)).join('');
  const drawn = (
    <>
      <path d={paths} />
      {found.map(
        ({ arrow }, k) =>
          arrow && (
            <path
              key={k}
              d="M-4 -3.2L4 0L-4 3.2Z"
              fill={overMap}
              fill-opacity={0.7}
              stroke="none"
              transform={`translate(${xOf(stage, arrow.x)} ${yOf(stage, arrow.r)}) rotate(${(-arrow.angle * 180) / Math.PI})`}
            />
          ),
      )}
    </>
  );
  return (
    <g fill="none" stroke={overMap} stroke-opacity={0.42} stroke-width={1}>
      <g>{drawn}</g>
      {!fields.whole && <g transform={mirrored(stage)}>{cloneElement(drawn, {})}</g>}
    </g>
  );
}

/** Least and greatest tension of the cortex in mN/m; null where there is none. */
export function tensionRange(surface: Fields['surface']): [number, number] | null {
  const tension = surface?.tension_mN_per_m;
  if (!tension?.length) return null;
  const [low, high] = [Math.min(...tension), Math.max(...tension)];
  return high > 0 || low < 0 ? [low, high] : null;
}

/** The colour of the cortex changes in so many steps from its least to its greatest tension. */
const tensionSteps = 48;

/** The cortex, coloured by its tension, thick along the contour; neighbours of one colour are one line. */
function Tension({ stage, surface }: { stage: Stage; surface: NonNullable<Fields['surface']> }) {
  const tension = surface.tension_mN_per_m;
  const range = tensionRange(surface);
  if (!tension || !range) return null;
  const step = (k: number) => Math.round((tensionSteps * shade(0.5 * (tension[k] + tension[k + 1]), ...range)) / 255);
  const pieces: [number, number][] = [];
  for (let k = 0; k + 1 < tension.length; ++k) {
    if (k > 0 && step(k) === step(k - 1)) pieces[pieces.length - 1][1] = k + 1;
    else pieces.push([k, k + 1]);
  }
  const half = pieces.map(([a, b]) => (
    <path
      key={a}
      d={pathOf(stage, { x_um: surface.x_um.slice(a, b + 1), r_um: surface.r_um.slice(a, b + 1) }, false)}
      stroke={tensionMap.css[Math.round((255 * step(a)) / tensionSteps)]}
    />
  ));
  return (
    <g fill="none" stroke-width={7} stroke-linecap="round" stroke-linejoin="round">
      <g>{half}</g>
      <g transform={mirrored(stage)}>{half.map((piece) => cloneElement(piece, {}))}</g>
    </g>
  );
}

/** Height of the middle of an outline, which a cell off the axis has beside it. */
const middleOf = ({ r_um }: Outline) => (r_um.some((r) => r < 0) ? (Math.min(...r_um) + Math.max(...r_um)) / 2 : 0);

function Cell({ stage, scene, looks, theme }: LinesProps) {
  const { contour, hull } = scene;
  const surface = scene.fields?.surface;
  const cortex = useMemo(() => (surface && looks.tension ? <Tension stage={stage} surface={surface} /> : null), [stage, surface, looks.tension, theme]);
  return (
    <g fill="none" stroke={overMap}>
      {looks.undeformed && (
        <circle
          cx={xOf(stage, 0)}
          cy={yOf(stage, contour ? middleOf(contour) : 0)}
          r={scene.undeformed_um * stage.scale}
          stroke-width={1.5}
          stroke-dasharray="2 4"
          stroke-linecap="round"
        />
      )}
      {cortex}
      {looks.hull && hull && <path d={pathOf(stage, wholeOutline(hull))} stroke-width={1.5} stroke-dasharray="7 4" />}
      {contour && <path class="contour" d={pathOf(stage, wholeOutline(contour))} stroke-width={looks.tension ? 2 : 3} stroke-linejoin="round" />}
    </g>
  );
}

/** A step in time has no fields: plain liquid and cell in the lightest colours of the maps. */
function PlainGround({ stage, contour }: { stage: Stage; contour: Outline | null }) {
  return (
    <g>
      <rect width={stage.width} height={stage.height} fill={liquidMap.css[24]} />
      {contour && <path d={pathOf(stage, wholeOutline(contour))} fill={cellMap.css[60]} />}
    </g>
  );
}

function ScaleBar({ stage }: { stage: Stage }) {
  const length = scaleBar_um(stage);
  const to = stage.width - 16;
  const from = to - length * stage.scale;
  const y = stage.height - 7;
  const ink = token('--ink');
  return (
    <g>
      <path d={`M${from} ${y}H${to}`} stroke={ink} stroke-width={3} />
      <text x={from - 8} y={y + 4} text-anchor="end" font-size={12} fill={ink}>
        {`${length} µm`}
      </text>
      <path d={`M16 ${y}H64m-7 -4l8 4l-8 4`} stroke={ink} stroke-width={1.5} fill="none" />
      <text x={74} y={y + 4} font-size={12} fill={ink}>
        flow
      </text>
    </g>
  );
}

export function Lines(props: LinesProps) {
  const { stage, scene, looks, mark } = props;
  const { fields, radius_um } = scene;
  // Neither a new contour nor the pointer changes the streamlines: they wait for new fields.
  const stream = useMemo(
    () => (looks.streamlines && fields ? <Stream stage={stage} fields={fields} radius_um={radius_um} /> : null),
    [stage, fields, radius_um, looks.streamlines],
  );
  return (
    <svg
      class="lines"
      xmlns="http://www.w3.org/2000/svg"
      width={stage.width}
      height={stage.height}
      viewBox={`0 0 ${stage.width} ${stage.height}`}
      font-family="system-ui, sans-serif"
      aria-hidden="true"
    >
      {!fields && <PlainGround stage={stage} contour={scene.contour} />}
      {stream}
      <Walls stage={stage} scene={scene} />
      <Cell {...props} />
      <ScaleBar stage={stage} />
      {mark && (
        <path
          class="mark"
          d="M-9 0H9M0 -9V9"
          stroke={overMap}
          stroke-width={1.5}
          transform={`translate(${xOf(stage, mark.x_um)} ${yOf(stage, mark.r_um)})`}
        />
      )}
    </svg>
  );
}
