// The cell of a duct with three.js: its surface, the channel's edges, and the camera that sees it in RT-DC.
import {
  AmbientLight,
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  ConeGeometry,
  DirectionalLight,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { token } from '../shell/theme';

export interface Solid {
  places: Float32Array;
  triangles: Uint32Array;
  width_um: number;
  height_um: number;
  /** Round the flow, 0: along the height. */
  camera_degree: number;
}

const turn = 0.12;

function surfaceOf({ places, triangles }: Solid): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(places, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  geometry.computeVertexNormals();
  return new Mesh(geometry, new MeshStandardMaterial({ color: new Color('#e5703a'), roughness: 0.55, side: 2 }));
}

function channelOf({ width_um, height_um }: Solid): LineSegments {
  const edges = new EdgesGeometry(new BoxGeometry(2.4 * Math.min(width_um, height_um), width_um, height_um));
  return new LineSegments(edges, new LineBasicMaterial({ color: new Color(token('--line-strong')) }));
}

/** A camera as a pyramid at its place outside the channel, and its line of sight. */
function cameraMark({ width_um, height_um, camera_degree }: Solid): Group {
  const group = new Group();
  const ink = new Color(token('--accent'));
  const turned = (camera_degree * Math.PI) / 180;
  const towards = new Vector3(0, Math.sin(turned), Math.cos(turned));
  const wall = 1 / Math.max((2 * towards.y) / width_um, (2 * towards.z) / height_um);
  const away = wall + 0.3 * width_um;
  const body = new Mesh(new ConeGeometry(0.11 * width_um, 0.16 * width_um, 4, 1, true), new MeshStandardMaterial({ color: ink, side: 2 }));
  body.position.copy(towards).multiplyScalar(away);
  body.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), towards);
  const sight = new BufferGeometry().setFromPoints([towards.clone().multiplyScalar(away), new Vector3()]);
  group.add(body, new LineSegments(sight, new LineBasicMaterial({ color: ink })));
  return group;
}

export class SolidView {
  private readonly renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(32, 1, 0.1, 5000);
  private readonly controls: OrbitControls;
  private readonly observer: ResizeObserver;
  private content = new Group();
  private width_um = 0;

  constructor(private readonly box: HTMLElement) {
    box.append(this.renderer.domElement);
    this.renderer.domElement.setAttribute('aria-hidden', 'true');
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener('change', () => this.draw());
    this.scene.add(new AmbientLight(0xffffff, 1.3));
    const light = new DirectionalLight(0xffffff, 2.2);
    light.position.set(1, 2, 3);
    this.camera.add(light);
    this.scene.add(this.camera, this.content);
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(box);
  }

  show(solid: Solid): void {
    this.scene.remove(this.content);
    this.content = new Group();
    this.content.add(surfaceOf(solid), channelOf(solid), cameraMark(solid));
    this.scene.add(this.content);
    if (this.width_um !== solid.width_um) {
      this.width_um = solid.width_um;
      this.camera.position.set(0.9, 1.1, 2.9).multiplyScalar(solid.width_um);
    }
    this.controls.update();
    this.resize();
  }

  key(event: KeyboardEvent): void {
    const turns: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const nearer: Record<string, number> = { '+': 0.9, '-': 1.1 };
    if (event.key in nearer) this.camera.position.multiplyScalar(nearer[event.key]);
    else if (event.key in turns) this.rotate(...turns[event.key]);
    else return;
    event.preventDefault();
    this.controls.update();
    this.draw();
  }

  dispose(): void {
    this.observer.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.domElement.remove();
  }

  private rotate(sideways: number, up: number): void {
    const { position } = this.camera;
    position.applyAxisAngle(new Vector3(0, 1, 0), sideways * turn);
    const axis = new Vector3().crossVectors(new Vector3(0, 1, 0), position).normalize();
    const angle = position.angleTo(new Vector3(0, 1, 0)) + up * turn;
    if (angle > 0.05 && angle < Math.PI - 0.05) position.applyAxisAngle(axis, up * turn);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.box;
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(clientWidth, clientHeight);
    this.camera.aspect = clientWidth / Math.max(1, clientHeight);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private draw(): void {
    this.renderer.render(this.scene, this.camera);
  }
}
