// What is left between the measured outline and the model's contour once size and place agree, along the contour.
import { useMemo } from 'preact/hooks';
import type { Curve, EventModel } from '../api';
import { significant } from '../draw/numbers';
import { alongAngles } from './residual';
import { ticksOf } from './scale';

const width = 280;
const height = 112;
const inner = { left: 44, right: 8, top: 8, bottom: 30 };

interface ResidualPlotProps {
  outline: Curve;
  model: EventModel;
  /** Side of a pixel in um: half of it is what a contour through pixels cannot tell. */
  pixel: number;
}

export function ResidualPlot({ outline, model, pixel }: ResidualPlotProps) {
  const found = useMemo(() => alongAngles(outline, model.residual_um), [outline, model]);
  const reach = 1.15 * Math.max(pixel || 0.3, ...found.distance_um.map(Math.abs));
  const x = (angle: number) => inner.left + ((angle + 180) / 360) * (width - inner.left - inner.right);
  const y = (distance: number) => inner.top + ((reach - distance) / (2 * reach)) * (height - inner.top - inner.bottom);
  const line = found.angle_deg.map((angle, k) => `${x(angle).toFixed(1)} ${y(found.distance_um[k]).toFixed(1)}`).join('L');
  return (
    <figure class="residual">
      <svg viewBox={`0 0 ${width} ${height}`} role="img" aria-label={`Distance of the outline from the model, rms ${significant(model.residual_rms_um, 2)} um`}>
        <rect class="pixel-band" x={inner.left} y={y(pixel / 2)} width={width - inner.left - inner.right} height={y(-pixel / 2) - y(pixel / 2)} />
        <g class="plot-axes">
          {ticksOf('linear', { low: -reach, high: reach }, 5).map(({ place, label }) => (
            <text key={place} x={inner.left - 6} y={y(place)} dy="0.32em" text-anchor="end">
              {label}
            </text>
          ))}
          {[-180, -90, 0, 90, 180].map((angle) => (
            <text key={angle} x={x(angle)} y={height - 16} text-anchor={angle === 180 ? 'end' : 'middle'}>
              {String(angle).replace('-', '−')}°
            </text>
          ))}
          <path d={`M${inner.left} ${inner.top}V${height - inner.bottom}H${width - inner.right}`} fill="none" />
          <path class="zero" d={`M${inner.left} ${y(0)}H${width - inner.right}`} />
          <text class="plot-title" transform={`translate(10 ${(height - inner.bottom + inner.top) / 2}) rotate(-90)`} text-anchor="middle">
            µm
          </text>
          <text class="plot-title" x={(inner.left + width - inner.right) / 2} y={height - 2} text-anchor="middle">
            angle from the flow
          </text>
        </g>
        <path class="residual-line" d={`M${line}`} />
      </svg>
      <figcaption class="soft">
        Outline minus model at the same size, rms {significant(model.residual_rms_um, 2)} µm; band: half a pixel.
      </figcaption>
    </figure>
  );
}
