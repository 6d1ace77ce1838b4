// The lines of the picture, as SVG: walls, streamlines, undeformed circle, contour, hull, tension, scale bar.
// Colours stand in attributes, not in the style sheet, so that an exported picture keeps them.
import { useMemo } from 'preact/hooks';
import type { Fields } from '../draw/fields';
import type { Outline } from '../api';
import { cellMap, liquidMap, shade, tensionMap } from '../draw/colormap';
import { streamlines } from '../draw/streamlines';
import { token } from '../shell/theme';
import type { Scene } from './Channel';
import { leftOf, pathOf, rightOf, scaleBar_um, wallPath, wholeOutline, xOf, yOf, type Stage } from './frame';
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

function Stream({ stage, scene }: { stage: Stage; scene: Scene }) {
  const found = useMemo(
    () => (scene.fields ? streamlines(scene.fields, leftOf(stage), rightOf(stage), scene.radius_um) : []),
    [scene, stage],
  );
  const both = found.flatMap(({ points }) =>
    [1, -1].map((side) => pathOf(stage, { x_um: points.map(([x]) => x), r_um: points.map(([, r]) => side * r) }, false)),
  );
  const arrows = found.flatMap(({ arrow }) => (arrow ? [1, -1].map((side) => ({ ...arrow, side })) : []));
  return (
    <g fill="none" stroke={overMap} stroke-opacity={0.42} stroke-width={1}>
      <path d={both.join('')} />
      {arrows.map(({ x, r, angle, side }, k) => (
        <path
          key={k}
          d="M-4 -3.2L4 0L-4 3.2Z"
          fill={overMap}
          fill-opacity={0.7}
          stroke="none"
          transform={`translate(${xOf(stage, x)} ${yOf(stage, side * r)}) rotate(${(-side * angle * 180) / Math.PI})`}
        />
      ))}
    </g>
  );
}

/** Least and greatest tension of the cortex in mN/m; null where there is none. */
export function tensionRange(fields: Fields | null): [number, number] | null {
  const tension = fields?.surface?.tension_mN_per_m;
  if (!tension?.length) return null;
  const [low, high] = [Math.min(...tension), Math.max(...tension)];
  return high > 0 || low < 0 ? [low, high] : null;
}

/** The cortex, coloured by its tension, thick along the contour. */
function Tension({ stage, scene }: { stage: Stage; scene: Scene }) {
  const surface = scene.fields?.surface;
  const tension = surface?.tension_mN_per_m;
  if (!surface || !tension?.length) return null;
  const range = tensionRange(scene.fields);
  if (!range) return null;
  const [low, high] = range;
  const every = Math.max(1, Math.floor(tension.length / 120));
  const pieces = [];
  for (let k = 0; k + every < tension.length; k += every) pieces.push([k, k + every]);
  return (
    <g fill="none" stroke-width={7} stroke-linecap="round">
      {pieces.flatMap(([a, b]) =>
        [1, -1].map((side) => (
          <path
            key={`${a} ${side}`}
            d={pathOf(stage, { x_um: [surface.x_um[a], surface.x_um[b]], r_um: [side * surface.r_um[a], side * surface.r_um[b]] }, false)}
            stroke={tensionMap.css[shade(0.5 * (tension[a] + tension[b]), low, high)]}
          />
        )),
      )}
    </g>
  );
}

function Cell({ stage, scene, looks }: LinesProps) {
  const { contour, hull } = scene;
  return (
    <g fill="none" stroke={overMap}>
      {looks.undeformed && (
        <circle
          cx={xOf(stage, scene.place_um)}
          cy={stage.axis}
          r={scene.undeformed_um * stage.scale}
          stroke-width={1.5}
          stroke-dasharray="2 4"
          stroke-linecap="round"
        />
      )}
      {looks.tension && <Tension stage={stage} scene={scene} />}
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
      {!scene.fields && <PlainGround stage={stage} contour={scene.contour} />}
      {looks.streamlines && scene.fields && <Stream stage={stage} scene={scene} />}
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
